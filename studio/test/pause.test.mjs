// Time that was stopped stays stopped: what the button says is what the engine does.
import assert from 'node:assert/strict';
import { after, afterEach, before, test } from 'node:test';
import { fakeServe } from './lib/fake_engine.mjs';
import { endServers, serve } from './lib/program.mjs';
import { begin, closePages, goesOn, openStudio, paused, picture, touched } from './lib/studio.mjs';

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
  await page.waitForFunction(() => Number.parseFloat(document.querySelector('[data-value=hand_travel_m]').textContent.replace('\u2212', '-')) < -6);
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

const button = (page, name) => page.getByRole('button', { name, exact: true });

test('a_page_that_is_loaded_again_while_time_is_stopped_says_so_and_one_press_goes_on', async () => {
  const server = await serve('paper_200', small);
  const { page, complaints } = await openStudio(tools, { address: server.address });
  await touched(page);
  const { time_s } = await paused(page);
  await page.reload();
  await button(page, 'Go on').waitFor();
  await goesOn(page);
  await page.waitForFunction((then) => Number.parseFloat(document.querySelector('[data-value=time_s]').textContent) > then + 0.5, time_s);
  assert.deepEqual(complaints, []);
});

test('a_page_that_watches_sees_the_pause_of_the_one_that_leads_and_has_none_of_its_own', async () => {
  const server = await serve('paper_200', small);
  const { page: leader } = await openStudio(tools, { address: server.address });
  await touched(leader);
  const { page: watcher } = await openStudio(tools, { address: server.address });
  await watcher.waitForFunction(() => /Someone else leads/.test(document.querySelector('.device').textContent));
  await picture(watcher).focus();
  await watcher.keyboard.press(' ');
  await watcher.waitForTimeout(500);
  assert.ok(await button(watcher, 'Pause').isDisabled());
  assert.equal(await watcher.locator('.refused').count(), 0);
  await paused(leader);
  await button(watcher, 'Go on').waitFor();
  await goesOn(leader);
  await button(watcher, 'Pause').waitFor();
});

test('a_choice_that_is_refused_leaves_button_and_engine_of_one_mind', async () => {
  const server = await fakeServe();
  const { page } = await openStudio(tools, { address: server.address });
  await paused(page);
  await page.getByLabel('Radius, mm').fill('0.1');
  await page.keyboard.press('Tab');
  await page.waitForSelector('.refused');
  await button(page, 'Pause').waitFor();
  assert.equal(server.now().paused, false);
  await server.close();
});

test('a_press_counts_once_however_long_the_bar_is_held_and_where_nothing_else_has_the_focus', async () => {
  const { page, complaints } = await openStudio(tools);
  await page.keyboard.down(' ');
  for (let repeats = 0; repeats < 3; ++repeats) await page.keyboard.down(' ');
  await page.keyboard.up(' ');
  await button(page, 'Go on').waitFor();
  await page.locator('#timeline').press('Home');
  await button(page, 'Back to now').click(); // and then it can take no focus any more
  await page.waitForFunction(() => document.activeElement === document.body); // which a browser sees when it draws
  await button(page, 'Go on').waitFor();
  await page.keyboard.press(' ');
  await button(page, 'Pause').waitFor();
  await button(page, 'Help').click();
  await page.locator('dialog h2').click();
  await page.keyboard.press(' ');
  assert.equal(await page.locator('[aria-label=Time] button').first().textContent(), 'Pause', 'what is asked of the help is not asked of the engine');
  assert.deepEqual(complaints, []);
});

test('only_a_hand_that_is_sent_another_way_lets_stopped_time_go_on', async () => {
  const server = await fakeServe();
  const { page } = await openStudio(tools, { address: server.address });
  await page.selectOption('#speed', '0.002');
  await picture(page).focus();
  await page.keyboard.press('s');
  await button(page, 'Hold still').waitFor();
  await paused(page);
  await page.selectOption('#speed', '0.005');
  await button(page, 'Hold still').click();
  await button(page, 'Steady hand').waitFor();
  assert.ok(await button(page, 'Go on').isVisible());
  assert.ok(server.now().paused);
  await button(page, 'Withdraw').click();
  await button(page, 'Pause').waitFor();
  assert.deepEqual(server.commands.filter(({ type }) => /steady|pause|resume/.test(type)).map(({ type, speed_m_s }) => speed_m_s ?? type), [0.002, 'pause', 0.005, 0, 'resume', -0.005]);
  await server.close();
});
