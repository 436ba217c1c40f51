// A page of headless Chromium with software WebGL that reports failures.
import { chromium } from 'playwright-core';

const PATIENCE = 1200e3; // ms

export function launch(program = '/usr/bin/chromium') {
  return chromium.launch({
    executablePath: program,
    args: [
      '--no-sandbox',
      '--disable-quic',
      '--no-first-run',
      '--disable-background-networking',
      '--disable-sync',
      '--disable-component-update',
      '--disable-dev-shm-usage',
      '--use-gl=angle',
      '--use-angle=swiftshader',
      '--enable-unsafe-swiftshader',
    ],
    timeout: PATIENCE,
  });
}

/// `errors`: of the console. `elsewhere`: requests to other addresses. The page has a separate context, in the browser
/// `running` if given. A busy machine draws slowly, so waits for a page last as long as the test may.
export async function openPage(address, viewport, program, options = {}, running = undefined) {
  const browser = running ?? (await launch(program));
  const page = await browser.newPage({ viewport, ...options });
  page.setDefaultTimeout(PATIENCE);
  const errors = [];
  const elsewhere = [];
  page.on('console', message => {
    if (message.type() === 'error') errors.push(message.text());
  });
  page.on('pageerror', error => errors.push(String(error)));
  page.on('request', request => {
    const url = request.url();
    if (!url.startsWith(address) && !url.startsWith('data:') && !url.startsWith('blob:')) elsewhere.push(url);
  });
  return { browser, page, errors, elsewhere };
}
