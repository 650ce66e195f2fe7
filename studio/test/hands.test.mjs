// Every hand: keys alone, mouse, wheel, touch, slider.
import assert from 'node:assert/strict';
import { after, afterEach, before, test } from 'node:test';
import { begin, closePages, openStudio, picture, readings, stageIs } from './lib/studio.mjs';

let tools;
before(async () => (tools = await begin()));
afterEach(closePages);
after(() => tools.end());

const travel = async (page) => Number.parseFloat((await readings(page)).hand_travel_m.replace('\u2212', '-'));
const goes = (page, least, most = Infinity) =>
  page.waitForFunction(
    ([a, b]) => {
      const now = Number.parseFloat(document.querySelector('[data-value=hand_travel_m]').textContent.replace('\u2212', '-'));
      return now >= a && now <= b;
    },
    [least, most === Infinity ? 1e9 : most],
  );
const settled = async (page) => {
  let before = await travel(page);
  for (;;) {
    await page.waitForTimeout(300);
    const now = await travel(page);
    if (now === before) return now;
    before = now;
  }
};
const hubPlace = async (page) => {
  const [box, top] = await Promise.all([
    page.locator('.scene').first().boundingBox(),
    page.evaluate(() => ({ x: Number(document.querySelector('line.axis').getAttribute('x1')), y: Number(document.querySelector('line.axis').getAttribute('y1')) })),
  ]);
  return { x: box.x + top.x, y: box.y + top.y - 12 };
};

test('keys_alone_do_everything', async () => {
  const { page, complaints } = await openStudio(tools);
  const start = await settled(page);
  await page.keyboard.press('ArrowDown');
  await page.keyboard.press('ArrowDown');
  await goes(page, start + 0.99, start + 1.01);
  await page.keyboard.press('Shift+ArrowDown');
  await goes(page, start + 4.99, start + 5.01);
  await page.keyboard.press('ArrowUp');
  await goes(page, start + 4.49, start + 4.51);
  await page.keyboard.press(' ');
  await page.getByRole('button', { name: 'Go on' }).waitFor();
  await page.keyboard.press('.');
  await page.keyboard.press(' ');
  await page.keyboard.press('w');
  await stageIs(page, 'free');
  await page.keyboard.press('r');
  await stageIs(page, 'contact');
  // Every control is reached by Tab, with a name and a visible focus.
  const met = new Set();
  for (let i = 0; i < 80; ++i) {
    await page.keyboard.press('Tab');
    const here = await page.evaluate(() => {
      const e = document.activeElement;
      const style = getComputedStyle(e);
      return { id: e.id || e.textContent.trim().slice(0, 30) || e.getAttribute('aria-label'), ring: e === document.body || style.outlineStyle !== 'none' };
    });
    if (here.id) met.add(here.id);
    assert.ok(here.ring, `the focus is seen on ${here.id}`);
  }
  for (const wanted of ['scene', 'needle-length_mm', 'needle-radius_mm', 'gauge', 'support', 'contact-rupture_force_N', 'field', 'hand', 'speed', 'rate', 'timeline', 'Steady hand', 'Withdraw', 'Reset', 'CSV', 'Replay file', 'theme', 'Help'])
    assert.ok(met.has(wanted), `${wanted} is reached by Tab`);
  assert.deepEqual(complaints, []);
});

test('mouse_pulls_the_hub_one_to_one_and_turns_the_view_elsewhere', async () => {
  const { page } = await openStudio(tools);
  const start = await settled(page);
  const hub = await hubPlace(page);
  const scale = await page.evaluate(() => Number(document.querySelector('.bar').dataset.scalePx) / Number(document.querySelector('.bar').dataset.scaleMm));
  const cos = await page.evaluate(() => {
    const axis = document.querySelector('line.axis');
    return (Number(axis.getAttribute('y2')) - Number(axis.getAttribute('y1'))) / 1;
  });
  assert.ok(cos > 0);
  await page.mouse.move(hub.x, hub.y);
  await page.mouse.down();
  await page.mouse.move(hub.x, hub.y + 10, { steps: 4 });
  const axisLength = (200 - start + 30) * scale; // px of hub to target, were the axis in the plane of the screen
  const wanted = (10 / scale) * (axisLength / cos);
  await goes(page, start + 0.9 * wanted, start + 1.1 * wanted);
  await page.mouse.up();
  const there = await settled(page);
  await page.mouse.move(hub.x - 120, hub.y + 60);
  await page.mouse.down();
  await page.mouse.move(hub.x - 40, hub.y + 60, { steps: 4 });
  await page.mouse.up();
  assert.equal(await settled(page), there, 'turning the view does not push');
  await page.mouse.wheel(0, 200);
  await goes(page, there + 0.45, there + 0.55);
});

test('a_finger_pulls_the_hub_on_a_tablet', async () => {
  const { page, context } = await openStudio(tools, { width: 768, height: 900, hasTouch: true, isMobile: true });
  const start = await settled(page);
  const hub = await hubPlace(page);
  const touch = await context.newCDPSession(page);
  const send = (type, y) => touch.send('Input.dispatchTouchEvent', { type, touchPoints: type === 'touchEnd' ? [] : [{ x: hub.x + 8, y }] });
  await send('touchStart', hub.y);
  for (let i = 1; i <= 4; ++i) await send('touchMove', hub.y + 3 * i);
  await goes(page, start + 3);
  await send('touchEnd');
});

test('the_slider_is_a_hand_too', async () => {
  const { page } = await openStudio(tools);
  await page.focus('#hand');
  const start = await settled(page);
  for (let i = 0; i < 20; ++i) await page.keyboard.press('ArrowRight');
  await goes(page, start + 1.8);
});

test('a_gamepad_pushes_and_rumbles_when_the_needle_buckles', async () => {
  const { page } = await openStudio(tools);
  const start = await settled(page);
  await page.evaluate(() => {
    window.rumbles = [];
    window.pad = { axes: [0, 1], buttons: [], vibrationActuator: { playEffect: (kind, { duration }) => (window.rumbles.push(duration), Promise.resolve('complete')) } };
    navigator.getGamepads = () => [window.pad];
    window.dispatchEvent(new Event('gamepadconnected'));
  });
  await goes(page, start + 3);
  await stageIs(page, 'buckled');
  await page.evaluate(() => (window.pad.axes[1] = 0.05)); // within what counts as rest
  assert.deepEqual(await page.evaluate(() => window.rumbles), [220]);
});
