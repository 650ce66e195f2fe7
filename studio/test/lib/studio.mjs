// What the tests do with the page: open it, read its numbers and its pixels.
import { openBrowser } from './browser.mjs';
import { serveSite } from './site.mjs';

export const patient = 60_000; // ms: software drawing on a busy machine

// One browser and one site for a file of tests.
export async function begin() {
  const [site, browser] = await Promise.all([serveSite(), openBrowser()]);
  return { site, browser, end: async () => void (await Promise.all([browser.close(), site.close()])) };
}

const opened = [];
export const closePages = () => Promise.all(opened.splice(0).map((context) => context.close()));

// A page in which anything the page itself complains about is kept in `complaints`.
export async function openStudio({ site, browser }, { width = 1000, height = 640, address = site.address, ready = true, ...context } = {}) {
  const made = await browser.newContext({ viewport: { width, height }, acceptDownloads: true, reducedMotion: 'reduce', ...context });
  opened.push(made);
  const page = await made.newPage();
  page.setDefaultTimeout(patient);
  const complaints = [];
  page.on('pageerror', (error) => complaints.push(String(error)));
  page.on('console', (message) => message.type() === 'error' && complaints.push(message.text()));
  await page.goto(address);
  if (ready) await page.waitForSelector('[data-stage=contact]');
  return { page, complaints, context: made };
}

export const picture = (page) => page.locator('[role=application]');
export const stageIs = (page, stage) => page.waitForSelector(`[data-stage=${stage}]`);

// Does what starts a new insertion, and waits for it to touch the tissue.
export async function anew(page, act) {
  const before = await page.getAttribute('.studio', 'data-run');
  await act();
  await page.waitForFunction((old) => document.querySelector('.studio').dataset.run !== old, before);
  await touched(page);
}
export const touched = (page) => page.waitForFunction(() => Number.parseFloat(document.querySelector('[data-value=hand_travel_m]').textContent) >= 0.4);

// Stops time and waits until the last moment is shown; gives its row of the trace.
export async function paused(page) {
  await picture(page).focus();
  await page.keyboard.press(' ');
  await page.getByRole('button', { name: 'Go on' }).waitFor();
  let before = '';
  for (let now = JSON.stringify(await readings(page)); now !== before; now = JSON.stringify(await readings(page))) {
    before = now;
    await page.waitForTimeout(200);
  }
  return rowsOf((await download(page, 'CSV')).bytes).at(-1);
}
export async function goesOn(page) {
  await picture(page).focus();
  await page.keyboard.press(' ');
  await page.getByRole('button', { name: 'Pause' }).waitFor();
}

// The texts of the read-outs by column.
export const readings = (page) =>
  page.evaluate(() => Object.fromEntries([...document.querySelectorAll('[data-value]')].map((e) => [e.dataset.value, e.textContent.trim()])));

// The same of a row of the trace, written anew.
export function written(row) {
  const minus = (text) => (Number.parseFloat(text) === 0 ? text.replace('-', '') : text.replace('-', '\u2212'));
  const as = (value, digits, unit, factor = 1) => `${minus((value * factor).toFixed(digits))} ${unit}`;
  return {
    hand_force_N: as(row.hand_force_N, 3, 'N'),
    critical_load_N: as(row.critical_load_N, 3, 'N'),
    hand_travel_m: as(row.hand_travel_m, 2, 'mm', 1e3),
    tip_depth_m: as(row.tip_depth_m, 2, 'mm', 1e3),
    inserted_length_m: as(row.inserted_length_m, 1, 'mm', 1e3),
    deflection_m: as(row.deflection_m, 2, 'mm', 1e3),
    time_s: as(row.time_s, 2, 's'),
    energy_residual_J: as(Math.abs(row.energy_residual_J), 2, 'nJ', 1e9),
  };
}

// What the page offers for download under a button, as text.
export async function download(page, name) {
  const [kept] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name, exact: true }).click()]);
  const parts = [];
  for await (const part of await kept.createReadStream()) parts.push(part);
  return { name: kept.suggestedFilename(), bytes: Buffer.concat(parts) };
}

export function rowsOf(csv) {
  const [head, ...lines] = csv.toString().trim().split('\n');
  const names = head.split(',');
  const read = (cell) => (Number.isNaN(Number(cell)) ? cell : Number(cell));
  return lines.map((line) => Object.fromEntries(line.split(',').map((cell, i) => [names[i], read(cell)])));
}

// Pixels of the picture's canvas: { width, height, ratio, data }, `ratio` to CSS pixels, `data` four bytes each.
export async function pixels(page) {
  const { text, ...size } = await page.evaluate(async () => {
    await new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)));
    const canvas = document.querySelector('.scene canvas');
    const copy = document.createElement('canvas');
    [copy.width, copy.height] = [canvas.width, canvas.height];
    const context = copy.getContext('2d', { willReadFrequently: true });
    context.drawImage(canvas, 0, 0);
    const { data } = context.getImageData(0, 0, copy.width, copy.height);
    let text = '';
    for (let i = 0; i < data.length; i += 0x8000) text += String.fromCharCode(...data.subarray(i, i + 0x8000));
    return { width: copy.width, height: copy.height, ratio: canvas.width / canvas.clientWidth, text: btoa(text) };
  });
  return { ...size, data: Buffer.from(text, 'base64') };
}

export const count = ({ data }, is) => {
  let found = 0;
  for (let i = 0; i < data.length; i += 4) if (is(data[i], data[i + 1], data[i + 2], data[i + 3])) ++found;
  return found;
};
