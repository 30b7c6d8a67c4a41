// Takes the place of three's Collada reader in the bundle: a report is one file and has no mesh
// files beside it. robot.ts tells the person about meshes it could not show.
export class ColladaLoader {
  load(): never {
    throw new Error('a report has no mesh files');
  }
}
