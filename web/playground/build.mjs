// SPDX-License-Identifier: Apache-2.0
// Builds the playground into a folder, which any web server may serve.
//
// usage: node build.mjs WRITE_WORLD FOLDER
//
// WRITE_WORLD: the program of data/write_world.cpp. The npm package is taken from build/web/package/dist, what builds the
// page from build/playground_npm. `make playground` makes all three and calls this.
import { execFileSync } from 'node:child_process';
import { copyFileSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';

// The times of day at which the worlds look best, seconds of their clocks.
const kWorlds = { sundial: 420, rts: 0, canopies: 0 };

const here = dirname(fileURLToPath(import.meta.url));
const root = join(here, '../..');
const npm = join(root, 'build/playground_npm');
const { build } = createRequire(join(npm, 'package.json'))('esbuild');
const packaged = join(root, 'build/web/package/dist');
const [writeWorld, folder] = process.argv.slice(2);
if (!folder) {
  console.error('usage: node build.mjs WRITE_WORLD FOLDER');
  process.exit(2);
}

execFileSync(join(npm, 'node_modules/.bin/tsc'), ['-p', here], { stdio: 'inherit' });
rmSync(folder, { recursive: true, force: true });
for (const part of ['worlds', 'pictures']) {
  mkdirSync(join(folder, part), { recursive: true });
}
for (const [name, time] of Object.entries(kWorlds)) {
  const file = join(folder, `worlds/${name}.world`);
  execFileSync(writeWorld, [name, String(time), file], { stdio: 'inherit' });
  writeFileSync(`${file}.gz`, gzipSync(readFileSync(file), { level: 9 }));
  rmSync(file);
}
execFileSync(writeWorld, ['--choices', join(folder, 'choices.json')]);
await build({
  entryPoints: ['main.ts', 'truth_worker.ts', 'style.css'].map((name) => join(here, 'src', name)), outdir: folder,
  alias: { 'gnomon-shadows': join(packaged, 'index.js') }, bundle: true, external: ['node:*'], minify: true, format: 'esm', target: 'es2022', loader: { '.wgsl': 'text' }, logLevel: 'warning',
});
for (const name of ['gnomon.wasm', 'shaders.json.gz']) {
  copyFileSync(join(packaged, name), join(folder, name));
}
copyFileSync(join(here, 'index.html'), join(folder, 'index.html'));
copyFileSync(join(root, 'site/favicon.svg'), join(folder, 'favicon.svg'));
const shown = readFileSync(join(here, 'src/without.ts'), 'utf8').matchAll(/\['([a-z-]+)', '/g);
for (const [, name] of shown) {
  copyFileSync(join(root, `docs/gallery/${name}.jpg`), join(folder, `pictures/${name}.jpg`));
}
const bytes = (at) => readdirSync(at, { withFileTypes: true, recursive: true }).filter((one) => one.isFile())
  .reduce((sum, one) => sum + readFileSync(join(one.parentPath ?? one.path, one.name)).length, 0);
console.log(`playground: ${(bytes(folder) / 1e6).toFixed(1)} MB in ${folder}`);
