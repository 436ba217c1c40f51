// Runs jobs of CesiumJS in a real browser: clients.mjs ADDRESS JOBS.json SHOTS [CHROMIUM]
//
// JOBS.json: a list of {kind: "sample" | "globe" | "tileset", …}, which clients.html explains; a job with a "shot"
// writes SHOTS/NAME.png. Prints JSON: the answers of the jobs, console errors, and requests to other addresses.
import { readFileSync } from 'node:fs';
import { openPage } from './browser.mjs';

const [address, jobsFile, shots, program] = process.argv.slice(2);
const { browser, page, errors, elsewhere } = await openPage(address, { width: 480, height: 320 }, program);
await page.goto(address + 'clients.html');
await page
  .waitForFunction(() => window.run !== undefined)
  .catch(error => {
    throw new Error([error, ...errors].join('\n'));
  });
const answers = [];
for (const job of JSON.parse(readFileSync(jobsFile, 'utf8'))) {
  answers.push(await page.evaluate(job => window.run(job), job));
  if (job.shot) await page.screenshot({ path: `${shots}/${job.shot}.png` });
}
console.log(JSON.stringify({ answers, errors, elsewhere }));
await browser.close();
