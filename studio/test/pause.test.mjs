// Time that was stopped stays stopped: what the button says is what the engine does.
import assert from 'node:assert/strict';
import { after, afterEach, before, test } from 'node:test';
import { endServers, serve } from './lib/program.mjs';
import { begin, closePages, openStudio, picture, touched } from './lib/studio.mjs';

let tools;
before(async () => (tools = await begin()));
afterEach(() => Promise.all([closePages(), endServers()]));
after(() => tools.end());

const small = { 'tissue.tetrahedra': 1000, 'run.time_step_ms': 5 };
const shownTravel = (page) => page.locator('[data-value=hand_travel_m]').textContent();

// Whatever an engine says reaches the page only half a second later, as on a machine that is busy.
async function hearsLate(page) {
  await page.addInitScript((late) => {
    for (const { prototype } of [Worker, WebSocket]) {
      const { set } = Object.getOwnPropertyDescriptor(prototype, 'onmessage');
      Object.defineProperty(prototype, 'onmessage', { set(hear) { set.call(this, (message) => setTimeout(() => hear(message), late)); } });
    }
  }, 500);
  await page.reload();
  await touched(page);
}

// The hand has gone to the end of its way already, and the page does not know yet; there it tells it to hold still.
async function pausesShortOfTheEnd(page) {
  await hearsLate(page);
  await picture(page).focus();
  await page.keyboard.press('w');
  await page.waitForFunction(() => document.querySelector('[data-value=hand_travel_m]').textContent.startsWith('\u22126'));
  await page.keyboard.press(' ');
  await page.waitForTimeout(1500);
  assert.ok(await page.getByRole('button', { name: 'Go on' }).isVisible(), 'it is paused');
  const there = await shownTravel(page);
  assert.ok(Number.parseFloat(there.replace('\u2212', '-')) <= -10, `${there} is the end of its way`);
  const time = await page.locator('.time').textContent();
  await page.waitForTimeout(500);
  assert.equal(await page.locator('.time').textContent(), time, 'and time stands still');
  assert.ok(await page.getByRole('button', { name: 'Withdraw' }).getAttribute('aria-pressed') === 'false', 'the hand holds still');
}

test('in_the_page_a_pause_outlasts_the_frames_that_were_on_their_way', async () => {
  const { page, complaints } = await openStudio(tools);
  await pausesShortOfTheEnd(page);
  assert.deepEqual(complaints, []);
});

test('at_a_server_a_pause_outlasts_the_frames_that_were_on_their_way', async () => {
  const server = await serve('paper_200', small);
  const { page, complaints } = await openStudio(tools, { address: server.address });
  await pausesShortOfTheEnd(page);
  assert.deepEqual(complaints, []);
});
