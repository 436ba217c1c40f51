// The blocks of the package's README in Chromium, each on a separate page: readme.mjs CHROMIUM README.
import fs from 'node:fs';
import { openPage } from './open_page.mjs';
import { serve } from './serve.mjs';

const [program, readme] = process.argv.slice(2);
const blocks = [...fs.readFileSync(readme, 'utf8').matchAll(/^```js\n(.*?)^```$/gms)].map(match => match[1]);
const entries = ['', '/full', '/lite', '/live', '/delatin', '/martini'].map(name => [
  `scarp${name}`,
  `./node_modules/scarp/${name.slice(1) || 'index'}.js`,
]);
const imports = {
  ...Object.fromEntries(entries),
  three: './node_modules/three/build/three.module.js',
  geotiff: './geotiff.js',
};
const server = await serve(process.cwd());
const { browser, page, errors } = await openPage(server.address, { width: 400, height: 300 }, program);
try {
  for (const [k, block] of blocks.entries()) {
    // A page loads one module.
    const prelude = block.includes("'scarp/live'") ? '' : "import './readme_prelude.mjs';\n";
    fs.writeFileSync(`readme_${k}.mjs`, `${prelude}${block}\nwindow.told = 'ran';\n`);
    fs.writeFileSync(
      `readme_${k}.html`,
      `<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,">
<script type="importmap">${JSON.stringify({ imports })}</script><script type="module" src="readme_${k}.mjs"></script>`,
    );
    await page.goto(`${server.address}/readme_${k}.html`);
    while (errors.length === 0 && !(await page.evaluate(() => window.told !== undefined)))
      await page.waitForTimeout(100);
    if (errors.length > 0) throw new Error(`block ${k}: ${errors.join('\n')}`);
  }
  console.log(`${blocks.length} blocks ran`);
} finally {
  await browser.close();
  server.close();
}
