// The other source: an engine at the end of a socket, here one whose numbers are made up and known.
import assert from 'node:assert/strict';
import { after, afterEach, before, test } from 'node:test';
import { fakeServe, rowAt } from './lib/fake_engine.mjs';
import { openBrowser } from './lib/browser.mjs';
import { closePages, openStudio, paused, picture, readings, stageIs, written } from './lib/studio.mjs';

let browser;
before(async () => (browser = await openBrowser()));
afterEach(closePages);
after(() => browser.close());

const opened = (server, options = {}) => openStudio({ browser }, { address: server.address, ...options });

test('frames_of_a_server_are_shown_to_the_digit', async () => {
  const server = await fakeServe();
  const { page, complaints } = await opened(server);
  await page.getByLabel('Hand', { exact: true }).fill('20');
  await stageIs(page, 'buckled');
  await page.waitForFunction(() => document.querySelector('[data-value=hand_travel_m]').textContent.startsWith('20.00'));
  await paused(page);
  const { travel, time } = server.now();
  const shown = await readings(page);
  assert.deepEqual(shown, written(rowAt(travel, time)));
  assert.ok(server.commands.some(({ type, travel_m }) => type === 'push' && Math.abs(travel_m - 0.02) < 1e-9));
  assert.deepEqual(complaints, []);
  await server.close();
});

test('a_lost_connection_is_shown_and_recovered', async () => {
  const server = await fakeServe();
  const { page } = await opened(server);
  await server.close();
  await page.waitForSelector('.link[data-link=lost]');
  assert.match(await page.locator('.story').textContent(), /trying again/);
  const again = await fakeServe({ port: server.port });
  await page.waitForSelector('.link[data-link=open]');
  await stageIs(page, 'contact');
  assert.match(await page.locator('.story').textContent(), /Push the needle/);
  await again.close();
});

test('a_device_is_armed_and_disarmed_with_its_limit_in_sight', async () => {
  const server = await fakeServe({ device: 'Inverse3' });
  const { page } = await opened(server, { ready: false });
  await page.waitForSelector('[data-gate=disarmed]');
  assert.match(await page.locator('.device').textContent(), /Inverse3.*at most 2\.0 N/s);
  assert.match(await page.locator('.story').textContent(), /The handle of the Inverse3 is its hub.*once it is armed/);
  await page.getByRole('button', { name: 'Arm', exact: true }).click();
  await page.waitForSelector('[data-gate=armed]');
  assert.match(await page.locator('.device').textContent(), /0\.50 N of at most 2\.0 N/);
  await page.getByRole('button', { name: 'Disarm' }).click();
  await page.waitForSelector('[data-gate=disarmed]');
  assert.deepEqual(
    server.commands.filter(({ type }) => type.endsWith('arm')).map(({ type }) => type),
    ['arm', 'disarm'],
  );
  await server.close();
});

test('what_an_engine_refuses_is_said_beside_the_choice_and_the_run_goes_on', async () => {
  const server = await fakeServe();
  const { page } = await opened(server);
  await page.getByLabel('Radius, mm').fill('0.1');
  await page.keyboard.press('Tab');
  await page.waitForSelector('.refused');
  assert.match(await page.locator('.refused').textContent(), /refuses so thin a needle/);
  await picture(page).focus();
  await page.keyboard.press('PageDown');
  await stageIs(page, 'buckled');
  server.say({ type: 'failed', sentence: 'the solver broke down at 0.4 s' });
  await page.waitForFunction(() => /solver broke down/.test(document.querySelector('.story').textContent));
  await page.getByRole('button', { name: 'Start again' }).click();
  await page.waitForFunction(() => /refuses|Push the needle/.test(document.body.textContent));
  await server.close();
});
