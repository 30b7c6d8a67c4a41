// Usage: node run_unit_tests.mjs FOLDER
// Bundles unit/*.test.ts into FOLDER and runs them with Node's own test runner.
import { spawnSync } from 'node:child_process';
import { readdirSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const require = createRequire(join(here, '../../viewer/package.json'));
const { buildSync } = require('esbuild');

const tests = readdirSync(join(here, 'unit')).filter((name) => name.endsWith('.test.ts'));
const outputs = tests.map((name) => join(process.argv[2], name.replace(/\.ts$/, '.mjs')));
tests.forEach((name, i) => {
  buildSync({
    entryPoints: [join(here, 'unit', name)],
    outfile: outputs[i],
    bundle: true,
    platform: 'node',
    format: 'esm',
    nodePaths: [join(here, '../../viewer/node_modules')],
    logLevel: 'warning',
  });
});
const result = spawnSync(process.execPath, ['--test', ...outputs], { stdio: 'inherit' });
process.exit(result.status ?? 1);
