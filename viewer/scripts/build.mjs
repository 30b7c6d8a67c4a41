// Usage: node build.mjs NAME OUT.html
// Bundles src/NAME.ts and src/NAME.html into one HTML page: styles and program inline.
// The same sources give the same bytes.
import { readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

const folder = dirname(dirname(fileURLToPath(import.meta.url)));
const [name, out] = process.argv.slice(2);
if (!out) {
  console.error('Usage: node build.mjs NAME OUT.html');
  process.exit(2);
}

async function bundle(entry, options) {
  const result = await build({
    absWorkingDir: folder,
    entryPoints: [entry],
    bundle: true,
    minify: true,
    write: false,
    charset: 'utf8',
    legalComments: 'none', // said once below, in full
    logLevel: 'warning',
    ...options,
  });
  return result.outputFiles[0].text;
}

// A URDF's meshes are files beside it, which a single page does not have: their reader stays out.
const script = await bundle(`src/${name}.ts`, {
  format: 'iife',
  target: ['es2020'],
  alias: { 'three/examples/jsm/loaders/ColladaLoader.js': './src/replay/no_mesh_reader.ts' },
});
const style = await bundle('src/style/page.css', { target: ['chrome100', 'firefox100', 'safari15'] });

function notice(library) {
  const path = join(folder, 'node_modules', library);
  const about = JSON.parse(readFileSync(join(path, 'package.json'), 'utf8'));
  const author = typeof about.author === 'string' ? about.author : about.author?.name;
  const head = `${library} ${about.version}, ${about.license}, by ${author ?? 'its authors'}`;
  if (about.license !== 'MIT') return `${head}. Licence: https://www.apache.org/licenses/LICENSE-2.0`;
  return `${head}\n${readFileSync(join(path, 'LICENSE'), 'utf8').trim()}`;
}
const notices = ['three', 'uplot', 'urdf-loader'].map(notice).join('\n\n').replace(/--/g, '- -');

const parts = {
  '/*style*/': style.replace(/<\/style/gi, '<\\/style'),
  '/*program*/': script.replace(/<\/script/gi, '<\\/script'),
  '<!--notices-->': `<!--\nThis page contains:\n\n${notices}\n-->`,
};
let page = readFileSync(join(folder, `src/${name}.html`), 'utf8');
for (const [mark, text] of Object.entries(parts)) {
  if (page.split(mark).length !== 2) throw new Error(`src/${name}.html must contain ${mark} once`);
  page = page.replace(mark, () => text);
}
writeFileSync(out, page);
