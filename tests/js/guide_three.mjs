// The lines of a guide in three.js: guide_three.mjs SHOTS CHROMIUM ADDRESS...
//
// Each page draws as window.draw() does until window.drawn is not 0. Prints JSON: for each the console errors, and the
// share of the picture that is not background. Writes SHOTS/three_0.png and so on.
import { openPage } from './browser.mjs';

const [shots, program, ...addresses] = process.argv.slice(2);
const answers = [];
for (const [k, address] of addresses.entries()) {
  const { browser, page, errors } = await openPage(address, { width: 400, height: 300 }, program);
  await page.goto(address);
  await page.waitForFunction(() => window.drawn > 0).catch(error => errors.push(String(error)));
  answers.push({ drawn: await page.evaluate(() => window.drawn ?? 0), errors });
  await page.screenshot({ path: `${shots}/three_${k}.png` });
  await browser.close();
}
console.log(JSON.stringify(answers));
