// Builds the page as one HTML file that opens from disk: build.mjs PAGE.html NPM_PACKAGE.
import { readFileSync, writeFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

const [page, engine] = process.argv.slice(2);
const here = dirname(fileURLToPath(import.meta.url));
const [{ text }] = (
  await build({
    entryPoints: [join(here, 'main.js')],
    bundle: true,
    write: false,
    minify: true,
    format: 'esm',
    target: 'es2022',
    define: { 'import.meta.url': '"about:blank"' },
    loader: { '.wasm': 'binary' },
    alias: { 'scarp/live.wasm': resolve(engine, 'live.wasm'), 'scarp/live': resolve(engine, 'live.js') },
    legalComments: 'eof',
    logLevel: 'warning',
  })
).outputFiles;
const script = text.replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--');
const html = readFileSync(join(here, 'page.html'), 'utf8').replace('/*SCRIPT*/', () => script);
writeFileSync(page, html);
console.log(`${page}: ${(html.length / 1e6).toFixed(2)} MB`);
