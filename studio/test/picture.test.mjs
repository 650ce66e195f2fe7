// The picture is the engine's.
import assert from 'node:assert/strict';
import { after, afterEach, before, test } from 'node:test';
import { begin, closePages, openStudio, paused, picture, pixels } from './lib/studio.mjs';

let tools;
before(async () => (tools = await begin()));
afterEach(closePages);
after(() => tools.end());

test('the_bow_is_drawn_as_large_as_the_trace_says', async () => {
  const { page } = await openStudio(tools, { width: 1200, height: 720 });
  await page.getByRole('button', { name: 'Side' }).click();
  await page.getByRole('button', { name: 'Options' }).click();
  await page.getByLabel('close-up of the entry').uncheck();
  await page.getByLabel('elements').uncheck();
  await page.getByRole('button', { name: 'Options' }).click();
  await picture(page).focus();
  await page.keyboard.press('s');
  await page.waitForFunction(() => Number.parseFloat(document.querySelector('[data-value=deflection_m]').textContent) > 25);
  const last = await paused(page);
  const drawn = await pixels(page);
  const { entry, scale, hub } = await page.evaluate(() => {
    const bar = document.querySelector('.bar');
    const axis = document.querySelector('line.axis');
    return {
      entry: { x: Number(document.querySelector('.entry circle').getAttribute('cx')), y: Number(document.querySelector('.entry circle').getAttribute('cy')) },
      hub: { y: Number(axis.getAttribute('y1')) },
      scale: Number(bar.dataset.scalePx) / Number(bar.dataset.scaleMm),
    };
  });
  // Row by row between hub and entry: the middle of the needle's dark outline.
  let most = 0;
  for (let y = Math.ceil(hub.y + 4); y < entry.y - 25; ++y) {
    const row = Math.round(y * drawn.ratio);
    const dark = [];
    for (let x = 0; x < drawn.width; ++x) {
      const i = 4 * (row * drawn.width + x);
      if (drawn.data[i + 3] > 128 && drawn.data[i] + drawn.data[i + 1] + drawn.data[i + 2] < 120) dark.push(x);
    }
    if (dark.length > 0) most = Math.max(most, (dark[0] + dark.at(-1) + 1) / 2 / drawn.ratio - entry.x);
  }
  const wanted = last.deflection_m * 1e3 * scale;
  assert.ok(wanted > 25, 'the bow is large enough to measure');
  assert.ok(Math.abs(most - wanted) < 1.5, `drawn ${most.toFixed(1)} px, the trace says ${wanted.toFixed(1)} px`);
});

test('the_cut_shows_the_inside_and_stress_has_its_own_legend', async () => {
  const { page } = await openStudio(tools);
  const colours = async () => {
    const { data } = await pixels(page);
    const seen = new Set();
    for (let i = 0; i < data.length; i += 4) if (data[i + 3] > 200) seen.add((data[i] >> 4) * 256 + (data[i + 1] >> 4) * 16 + (data[i + 2] >> 4));
    return seen.size;
  };
  const cut = await colours();
  await page.selectOption('#field', 'stress');
  await page.waitForFunction(() => /kPa/.test(document.querySelector('.legend').textContent));
  await page.getByRole('button', { name: 'Options' }).click();
  await page.getByLabel('cut through the needle').uncheck();
  await page.waitForTimeout(500);
  assert.notEqual(await colours(), cut);
});
