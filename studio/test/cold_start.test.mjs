// The first visit: what has to come through the wire. How long it then takes is told, not judged: it is the machine's.
import { readdirSync, readFileSync } from 'node:fs';
import { gzipSync } from 'node:zlib';
import assert from 'node:assert/strict';
import { after, afterEach, before, test } from 'node:test';
import { dist } from './lib/site.mjs';
import { begin, closePages, openStudio, touched } from './lib/studio.mjs';

let tools;
before(async () => (tools = await begin()));
afterEach(closePages);
after(() => tools.end());

const packed = (files) => files.reduce((sum, file) => sum + gzipSync(readFileSync(`${dist}/${file}`), { level: 9 }).length, 0);

test('the_page_and_its_engine_are_light', (t) => {
  const files = readdirSync(dist, { recursive: true, withFileTypes: true }).filter((one) => one.isFile()).map((one) => `${one.parentPath ?? one.path}/${one.name}`.slice(dist.length));
  const engine = files.filter((file) => file.endsWith('.wasm'));
  assert.equal(engine.length, 1);
  t.diagnostic(`compressed: the page ${packed(files)} bytes in all, its engine ${packed(engine)}`);
  assert.ok(packed(files) < 1_500_000);
  assert.ok(packed(engine) < 300_000);
});

test('a_first_visit_paints_and_runs', async (t) => {
  const { page } = await openStudio(tools, { ready: false }); // a new context: nothing is cached
  await page.waitForFunction(() => Number.parseFloat(document.querySelector('[data-value=time_s]')?.textContent) > 0);
  const running = await page.evaluate(() => performance.now());
  const painted = await page.evaluate(() => performance.getEntriesByName('first-contentful-paint')[0]?.startTime);
  assert.ok(painted > 0, 'something was painted');
  t.diagnostic(`first paint with content after ${painted.toFixed(0)} ms, first running frame after ${running.toFixed(0)} ms`);
  await touched(page);
});
