// Builds the viewer as one HTML file: build.mjs PAGE.html [NPM_PACKAGE]. NPM_PACKAGE is the folder of the package
// `scarp`, whose engine then refines live in the page.
import { readFileSync, existsSync, mkdirSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

const [page, engine] = process.argv.slice(2);
const here = dirname(fileURLToPath(import.meta.url));
const source = join(here, 'src');
const hasEngine =
  engine !== undefined && existsSync(join(engine, 'inline.js')) && existsSync(join(engine, 'inline-data.js'));
const shared = {
  bundle: true,
  write: false,
  minify: true,
  format: 'iife',
  target: 'es2022',
  define: { 'import.meta.url': '"about:blank"', HAS_ENGINE: String(hasEngine) },
  logLevel: 'warning',
  legalComments: 'eof',
};

async function bundle(entry, options) {
  return (await build({ ...shared, ...options, entryPoints: [join(source, entry)] })).outputFiles[0].text;
}

const worker = hasEngine ? await bundle('worker.js', { alias: { 'scarp/inline': join(engine, 'inline.js') } }) : '';
const sources = { 'worker-source': worker, 'judge-source': await bundle('judge_worker.js') };
const script = await bundle('main.js', {
  plugins: [
    {
      name: 'sources',
      setup({ onResolve, onLoad }) {
        onResolve({ filter: /^(worker|judge)-source$/ }, ({ path }) => ({ path, namespace: 'sources' }));
        onLoad({ filter: /.*/, namespace: 'sources' }, ({ path }) => ({ contents: sources[path], loader: 'text' }));
      },
    },
  ],
});
const html = readFileSync(join(source, 'page.html'), 'utf8')
  .replace('/*STYLE*/', () => readFileSync(join(source, 'style.css'), 'utf8'))
  .replace('/*SCRIPT*/', () => script.replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--'));
mkdirSync(dirname(page), { recursive: true });
writeFileSync(page, html);
const about = hasEngine ? 'with the engine' : 'without the engine (make npm builds it)';
console.log(`${page}: ${(html.length / 1e6).toFixed(2)} MB, ${about}`);
