// Packs app.mjs by the guides of the bundlers: bundle.mjs NAME, into the folder NAME.
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';

const [name] = process.argv.slice(2);
const head = `<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,"><title>${name}</title>`;
const page = script => `${head}<script type="module" src="${script}"></script>\n`;
fs.mkdirSync(name, { recursive: true });
switch (name) {
  case 'esbuild': {
    // keeps new URL() unchanged: the module and the worker are placed next to the script
    const { build } = await import('esbuild');
    await build({
      entryPoints: ['app.mjs', 'node_modules/scarp/worker.js'],
      entryNames: '[name]',
      bundle: true,
      format: 'esm',
      minify: true,
      outdir: name,
    });
    fs.copyFileSync('node_modules/scarp/scarp.wasm', `${name}/scarp.wasm`);
    fs.writeFileSync(`${name}/index.html`, page('app.js'));
    break;
  }
  case 'inline': {
    // a page that works from a file
    const { build } = await import('esbuild');
    const {
      outputFiles: [script],
    } = await build({
      entryPoints: ['app.mjs'],
      bundle: true,
      format: 'esm',
      minify: true,
      write: false,
      alias: { scarp: 'scarp/inline' },
    });
    const text = script.text.replaceAll('</script', '<\\/script');
    fs.writeFileSync(`${name}/index.html`, `${head}<script type="module">${text}</script>\n`);
    break;
  }
  case 'formats': {
    // without import.meta.url
    const { build } = await import('esbuild');
    for (const format of ['cjs', 'iife']) {
      for (const [entry, told] of [
        ['scarp', /^FAILED unsupported .*--format=esm, or import 'scarp\/inline'.*ready\(url\)/],
        ['scarp/inline', /^2 triangles$/],
      ]) {
        const contents = `import { simplify } from '${entry}';
          simplify([0, 0, 0, 9], 2, 2, { maxError: 1 }).then(
            mesh => console.log(mesh.triangleCount + ' triangles'),
            ({ code, message }) => console.log('FAILED', code, message),
          );`;
        await build({
          stdin: { contents, resolveDir: '.' },
          bundle: true,
          format,
          platform: 'node',
          outfile: `${name}/app.cjs`,
          logLevel: 'error',
        });
        const answer = execFileSync(process.execPath, [`${name}/app.cjs`])
          .toString()
          .trim();
        if (!told.test(answer)) throw new Error(`${entry} as ${format}: ${answer}`);
      }
    }
    break;
  }
  case 'vite': {
    const { build } = await import('vite');
    fs.writeFileSync('vite.html', page('/app.mjs'));
    await build({
      root: process.cwd(),
      base: './',
      logLevel: 'warn',
      configFile: false,
      build: { outDir: name, emptyOutDir: true, target: 'es2022', rollupOptions: { input: 'vite.html' } },
    });
    break;
  }
  case 'webpack': {
    const { default: webpack } = await import('webpack');
    const stats = await new Promise((resolve, reject) =>
      webpack(
        {
          mode: 'production',
          context: process.cwd(),
          entry: './app.mjs',
          performance: false,
          output: { path: `${process.cwd()}/webpack`, filename: 'app.js' },
        },
        (error, done) => (error ? reject(error) : resolve(done)),
      ),
    );
    if (stats.hasErrors() || stats.hasWarnings()) throw new Error(stats.toString());
    fs.writeFileSync(`${name}/index.html`, page('app.js'));
    break;
  }
}
