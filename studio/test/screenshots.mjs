// Pictures of the page for its documentation, into docs/pictures: the same moments of the same insertions each time.
import { fileURLToPath } from 'node:url';
import { anew, begin, openStudio, picture, stageIs } from './lib/studio.mjs';

const folder = fileURLToPath(new URL('../../docs/pictures/', import.meta.url));
const tools = await begin();

const bowed = (page, least) => page.waitForFunction((mm) => Number.parseFloat(document.querySelector('[data-value=deflection_m]').textContent) > mm, least);

async function hold(page) {
  await picture(page).focus();
  await page.keyboard.press(' ');
  await page.evaluate(() => document.activeElement.blur());
  await page.mouse.move(0, 0);
  await page.waitForTimeout(900);
}

// The paper's needle, buckled.
async function buckled(page) {
  await page.selectOption('#speed', '0.02');
  await picture(page).focus();
  await page.keyboard.press('s');
  await stageIs(page, 'buckled');
  await bowed(page, 32);
  await hold(page);
}

// The paper's Fig. 6 to its end, with the paper's Fig. 7 needle as an earlier curve.
async function secondBuckling(page) {
  await page.selectOption('#speed', '0.02');
  await picture(page).focus();
  await page.keyboard.press('s');
  await bowed(page, 25);
  await anew(page, () => page.selectOption('#scene', 'fig6-clamped_pinned'));
  await picture(page).focus();
  await page.keyboard.press('s');
  await stageIs(page, 'inserted_buckled');
  await page.selectOption('#speed', '0.005');
  await bowed(page, 18);
  await hold(page);
}

const shots = {
  'studio-first': [{ width: 1280, height: 720 }, async (page) => void (await page.waitForTimeout(1200))],
  'studio-light': [{ width: 1280, height: 720 }, secondBuckling],
  'studio-dark': [{ width: 1280, height: 720, colorScheme: 'dark' }, buckled],
  'studio-tablet': [{ width: 768, height: 1024, hasTouch: true, isMobile: true }, buckled],
  'studio-zoom200': [{ width: 640, height: 360, deviceScaleFactor: 2 }, buckled],
};
const wanted = process.argv.slice(2);
for (const [name, [options, act]] of Object.entries(shots)) {
  if (wanted.length > 0 && !wanted.includes(name)) continue;
  const { page, context } = await openStudio(tools, { colorScheme: 'light', ...options });
  await act(page);
  await page.screenshot({ path: `${folder}${name}.png` });
  console.log(`${folder}${name}.png`);
  await context.close();
}
await tools.end();
