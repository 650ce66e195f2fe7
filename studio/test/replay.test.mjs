// What was: scrub, replay, compare, and the one file that opens from disk.
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import assert from 'node:assert/strict';
import { after, afterEach, before, test } from 'node:test';
import { anew, begin, closePages, count, download, openStudio, paused, picture, pixels, readings, rowsOf, stageIs, written } from './lib/studio.mjs';

let tools;
const folder = mkdtempSync(join(tmpdir(), 'acus-replay-'));
before(async () => (tools = await begin()));
afterEach(closePages);
after(async () => {
  await tools.end();
  rmSync(folder, { recursive: true });
});

const scrubbed = (page, index) =>
  page.$eval('#timeline', (input, to) => {
    input.value = String(to);
    input.dispatchEvent(new Event('input', { bubbles: true }));
  }, index);

test('scrubbing_shows_the_past_and_back_to_now_goes_on', async () => {
  const { page, complaints } = await openStudio(tools);
  await page.keyboard.press('s');
  await stageIs(page, 'buckled');
  await scrubbed(page, 3);
  await page.waitForFunction(() => document.querySelector('[data-stage]').dataset.stage !== 'buckled');
  const rows = rowsOf((await download(page, 'CSV')).bytes);
  assert.deepEqual(await readings(page), written(rows[3]));
  const events = await page.locator('.events span').count();
  assert.ok(events >= 2);
  await page.getByRole('button', { name: 'Back to now' }).click();
  await stageIs(page, 'buckled');
  assert.deepEqual(complaints, []);
});

test('a_replay_file_opens_from_disk_and_shows_the_same_numbers', async () => {
  const { page, context } = await openStudio(tools);
  await page.keyboard.press('s');
  await page.waitForFunction(() => Number.parseFloat(document.querySelector('[data-value=deflection_m]').textContent) > 15);
  await paused(page);
  const rows = rowsOf((await download(page, 'CSV')).bytes);
  const { name, bytes } = await download(page, 'Replay file');
  assert.match(name, /\.html$/);
  const file = join(folder, 'replay.html');
  writeFileSync(file, bytes);

  const { page: replay, complaints } = await openStudio(tools, { address: pathToFileURL(file).href, ready: false });
  const asked = [];
  replay.on('request', (request) => asked.push(request.url()));
  await stageIs(replay, rows.at(-1).stage);
  assert.deepEqual(await readings(replay), written(rows.at(-1)));
  const drawn = await pixels(replay);
  assert.ok(count(drawn, (r, g, b, a) => a > 200) > 0.03 * drawn.width * drawn.height, 'the picture is not blank');
  await scrubbed(replay, 5);
  await replay.waitForFunction((time) => document.querySelector('[data-value=time_s]').textContent === time, written(rows[5]).time_s);
  assert.deepEqual(await readings(replay), written(rows[5]));
  await replay.getByRole('button', { name: 'Replay' }).click();
  await stageIs(replay, 'buckled');
  assert.deepEqual(asked.filter((url) => !/^(data|blob):/.test(url)), []);
  assert.deepEqual(complaints, []);
});

test('two_runs_stand_side_by_side', async () => {
  const { page, complaints } = await openStudio(tools);
  await page.keyboard.press('s');
  await stageIs(page, 'buckled');
  await anew(page, async () => {
    await page.getByLabel('Length, mm').fill('150');
    await page.keyboard.press('Tab');
  });
  assert.match(await page.locator('[data-words]').textContent(), /go in straight/);
  await page.selectOption('#compare', { index: 1 });
  assert.equal(await page.locator('.scene').count(), 2);
  assert.match(await page.locator('.caption').nth(1).textContent(), /earlier: 200 mm/);
  await picture(page).focus();
  await page.keyboard.press('PageDown');
  await page.waitForFunction(() => /bow/.test(document.querySelectorAll('.scene')[1].querySelector('svg').textContent));
  assert.deepEqual(complaints, []);
});
