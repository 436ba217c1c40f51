// Checks pages of the viewer in a real browser, from disk: viewer.mjs JOBS.json SHOTS [CHROMIUM]
//
// JOBS.json: a list of {page, folder, width, height, dark, forced_colors, no_script, before, steps, axe}. `folder`:
// allowed requests besides the page. `before` runs in the page before its script; each step is {drop: [{name, path}],
// do: JavaScript, keys, clicks, until: JavaScript, read: JavaScript, shot: name, after}; without SHOTS no shot.
// Prints JSON, one answer a job: the values of `do` and `read`, console errors, requests to other addresses, and
// axe-core's objections.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';
import { launch, openPage } from './browser.mjs';

const [jobsFile, shots, program] = process.argv.slice(2);
const browser = await launch(program);
const axeSource = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

/// Playwright's function evaluates text in the page, which the page's policy forbids.
async function waitFor(page, condition) {
  while (!(await page.evaluate(condition))) await page.waitForTimeout(100);
}

async function doJob(job) {
  const address = pathToFileURL(job.page).href;
  const { page, errors, elsewhere } = await openPage(
    job.folder ? pathToFileURL(job.folder).href : address,
    { width: job.width ?? 1100, height: job.height ?? 700 },
    program,
    { javaScriptEnabled: !job.no_script },
    browser,
  );
  try {
    await page.emulateMedia({
      colorScheme: job.dark ? 'dark' : 'light',
      reducedMotion: 'reduce',
      forcedColors: job.forced_colors ? 'active' : 'none',
    });
    if (job.before) await page.addInitScript(job.before);
    await page.goto(address + (job.fragment ?? ''));
    const values = [];
    for (const step of job.steps) {
      if (step.drop) {
        const files = step.drop.map(({ name, path }) => ({ name, base64: readFileSync(path).toString('base64') }));
        await page.evaluate(async files => {
          const transfer = new DataTransfer();
          for (const { name, base64 } of files)
            transfer.items.add(new File([Uint8Array.from(atob(base64), letter => letter.charCodeAt(0))], name));
          window.dispatchEvent(new DragEvent('drop', { dataTransfer: transfer, cancelable: true }));
        }, files);
      }
      if (step.do) values.push(await page.evaluate(step.do));
      for (const key of step.keys ?? []) await page.keyboard.press(key);
      for (const at of step.clicks ?? []) await page.mouse.click(...at);
      if (step.until) await waitFor(page, step.until);
      if (step.read) values.push(await page.evaluate(step.read));
      if (step.shot && shots) await page.screenshot({ path: `${shots}/${step.shot}.png` });
      if (step.after) await page.evaluate(step.after);
    }
    let violations = [];
    if (job.axe) {
      await page.evaluate(axeSource);
      violations = (await page.evaluate(() => axe.run())).violations.map(
        ({ id, nodes }) => `${id}: ${nodes.map(node => node.html).join(' ')}`,
      );
    }
    return { values, errors, elsewhere, violations };
  } catch (error) {
    return { failed: String(error), errors, elsewhere };
  } finally {
    await page.close();
  }
}

const answers = [];
for (const job of JSON.parse(readFileSync(jobsFile, 'utf8'))) answers.push(await doJob(job));
await browser.close();
console.log(JSON.stringify(answers));
