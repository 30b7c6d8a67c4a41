// Usage: node install.mjs [--with-tests]
// Brings viewer/node_modules to what package-lock.json says; what only the tests need with
// --with-tests alone. Does nothing, and needs no network, if it is there already.
import { spawnSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const folder = dirname(dirname(fileURLToPath(import.meta.url)));
const withTests = process.argv.includes('--with-tests');
const npm = process.env.NPM_PROGRAM ?? 'npm';

function readJson(...path) {
  return JSON.parse(readFileSync(join(folder, ...path), 'utf8'));
}

// npm leaves the lock of what it installed in node_modules; packages for other machines are not in
// it, so every package of the lock must be installed in its version unless it is optional.
function isInstalled() {
  if (!existsSync(join(folder, 'node_modules', '.package-lock.json'))) return false;
  const installed = readJson('node_modules', '.package-lock.json').packages;
  const locked = Object.entries(readJson('package-lock.json').packages).filter(
    ([path, entry]) => path !== '' && !entry.optional && (withTests || !entry.dev),
  );
  const { dependencies, devDependencies } = readJson('package.json');
  const named = Object.entries({ ...dependencies, ...(withTests && devDependencies) });
  return (
    locked.every(([path, entry]) => installed[path]?.version === entry.version) &&
    named.every(([name, version]) => installed[`node_modules/${name}`]?.version === version)
  );
}

if (!isInstalled()) {
  const scope = withTests ? [] : ['--omit=dev'];
  const result = spawnSync(npm, ['ci', ...scope, '--no-audit', '--no-fund', '--loglevel=error'], {
    cwd: folder,
    stdio: ['ignore', 2, 2],
  });
  if (result.error || result.status !== 0) {
    console.error(
      `viewer: the packages of the report page could not be installed ` +
        `(${result.error?.message ?? `npm ci ended with ${result.status}`}).\n` +
        `The first build needs the npm registry, directly or through npm's proxy or registry setting. ` +
        `Try: cd ${folder} && npm ci`,
    );
    process.exit(1);
  }
}
