// The package in Chromium: browser.mjs CHROMIUM TOLD [BUNDLE...]. A plain module makes Node's meshes. Each BUNDLE, a
// page in this folder or next to it (file:), or from vite's dev server without configuration (dev:), reports TOLD.
import { pathToFileURL } from 'node:url';
import { openPage } from './open_page.mjs';
import { serve } from './serve.mjs';

const [program, told, ...bundles] = process.argv.slice(2);
const server = await serve(process.cwd());
const { browser, page, errors } = await openPage(server.address, { width: 400, height: 300 }, program);
/// The dev server and a page of it. It packs the page's imports at the first visit, and caches outside the package.
async function openDev(page) {
  const { createServer } = await import('vite');
  const dev = await createServer({
    root: process.cwd(),
    configFile: false,
    cacheDir: 'elsewhere',
    logLevel: 'warn',
    server: { host: '127.0.0.1' },
  });
  await dev.listen();
  return { address: `${dev.resolvedUrls.local[0]}${page}`, close: () => dev.close() };
}
const visit = async address => {
  await page.goto(address);
  await page.waitForFunction(() => window.told !== undefined);
  return page.evaluate(() => window.told);
};
const fail = message => {
  console.error(`FAILED: ${message}`);
  process.exitCode = 1;
};
try {
  for (const where of ['', '/isolated']) {
    const answer = await visit(`${server.address}${where}/page.html`);
    console.log(where || '/', JSON.stringify(answer));
    if (answer.failed || answer.wrong.length > 0 || answer.cancelled !== 'cancelled' || !(answer.after > 0))
      fail(JSON.stringify(answer));
    const [first, lost, next] = answer.made;
    if (!(first > 0) || next !== first || !/^memory: the browser ended a worker/.test(lost))
      fail(`a worker that ended: ${answer.made}`);
    if (answer.isolated !== (where === '/isolated')) fail('the headers were not obeyed');
  }
  if (errors.length > 0) fail(errors.join('\n'));
  const strict = await visit(`${server.address}/strict/page.html`);
  console.log('/strict', JSON.stringify(strict));
  if (strict.refused !== 'unsupported' || !/wasm-unsafe-eval/.test(strict.message))
    fail('a refusal of WebAssembly has no sentence');
  const policies = [
    ['whole', /^2 triangles$/],
    ['deaf', /^input: .*scarp\.wasm cannot be loaded: .*connect-src/],
    ['lone', /^internal: a worker failed: .*worker-src 'self'/],
    ['blob', /^2 triangles$/, '?inline'],
    ['whole', /^internal: a worker failed: .*needs worker-src blob:$/, '?inline'],
    ['typed', /^unsupported: .*require-trusted-types-for refuses the worker's address.*createScriptURL/],
  ];
  for (const [policy, sentence, entry = ''] of policies) {
    await page.goto(`${server.address}/${policy}/policy.html${entry}`);
    const answer = await page.evaluate(() => window.told); // waiting for it would need eval()
    console.log(`/${policy}${entry}`, answer);
    if (!sentence.test(answer)) fail(`the policy ${policy} with scarp${entry}: ${answer}`);
  }
  errors.length = 0;
  for (const bundle of bundles) {
    const dev = bundle.startsWith('dev:') ? await openDev(bundle.slice(4)) : null;
    const answer = await visit(
      dev?.address ??
        (bundle.startsWith('file:') ? pathToFileURL(bundle.slice(5)).href : `${server.address}/${bundle}`),
    );
    if (dev) await page.goto('about:blank'); // else it misses the server
    await dev?.close();
    console.log(bundle, answer);
    if (answer !== told) fail(`${bundle} tells ${answer}, and Node ${told}`);
    if (errors.length > 0) fail(`${bundle}: ${errors.splice(0).join('\n')}`);
  }
} finally {
  await browser.close();
  server.close();
}
