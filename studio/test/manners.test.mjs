// Manners: contrast, names, light and dark, large text, little motion.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import assert from 'node:assert/strict';
import { after, afterEach, before, test } from 'node:test';
import { begin, closePages, openStudio, stageIs } from './lib/studio.mjs';

const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
let tools;
before(async () => (tools = await begin()));
afterEach(closePages);
after(() => tools.end());

async function violations(page) {
  await page.evaluate(axe);
  const { violations: found } = await page.evaluate(() => window.axe.run(document, { runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'] }));
  return found.flatMap(({ id, nodes }) => nodes.map((node) => `${id}: ${node.target} ${node.failureSummary}`));
}

for (const [name, options] of Object.entries({
  light: { colorScheme: 'light' },
  dark: { colorScheme: 'dark' },
  tablet: { width: 768, height: 1024, hasTouch: true },
  'large text': { width: 640, height: 360 },
}))
  test(`axe_finds_nothing_${name.replace(' ', '_')}`, async () => {
    const { page } = await openStudio(tools, options);
    assert.deepEqual(await violations(page), []);
    await page.keyboard.press('s');
    await stageIs(page, 'buckled');
    await page.keyboard.press(' '); // nothing is drawn meanwhile
    await page.getByRole('button', { name: 'Table' }).click();
    await page.getByRole('button', { name: 'Options' }).click();
    assert.deepEqual(await violations(page), []);
    const wide = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
    assert.ok(wide <= 0, 'nothing sticks out sideways');
    await page.getByRole('button', { name: 'Help' }).click();
    assert.deepEqual(await violations(page), []);
  });

test('every_slider_has_a_name_and_a_value_with_its_unit', async () => {
  const { page } = await openStudio(tools);
  await page.getByRole('button', { name: 'Options' }).click();
  const sliders = await page.evaluate(() =>
    [...document.querySelectorAll('input[type=range]')].map((e) => ({ id: e.id, label: document.querySelector(`label[for="${e.id}"]`)?.textContent.trim() ?? '', said: e.getAttribute('aria-valuetext') ?? '' })),
  );
  assert.ok(sliders.length >= 8);
  for (const { id, label } of sliders) assert.ok(label.length > 2, `${id} has a label of its own`);
  for (const { id, said } of sliders.filter((one) => one.id.includes('-') && one.id !== 'target-depth')) assert.match(said, /\d.* \S+/, `${id} says its unit`);
  assert.equal(await page.locator('label output').count(), 0);
});

test('light_and_dark_follow_the_system_and_the_switch', async () => {
  const { page } = await openStudio(tools, { colorScheme: 'dark' });
  const paper = () => page.evaluate(() => getComputedStyle(document.querySelector('.picture')).backgroundColor);
  const dark = await paper();
  await page.emulateMedia({ colorScheme: 'light' });
  await page.waitForFunction(() => document.documentElement.dataset.theme === 'light');
  assert.notEqual(await paper(), dark);
  await page.selectOption('#theme', 'dark');
  assert.equal(await paper(), dark);
  await page.reload();
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), 'dark', 'the choice is kept');
});

test('little_motion_is_respected', async () => {
  const { page } = await openStudio(tools, { reducedMotion: 'reduce' });
  const moving = await page.evaluate(() => document.getAnimations().length);
  assert.equal(moving, 0);
});

test('the_page_asks_no_other_host', async () => {
  const { page } = await openStudio(tools, { ready: false });
  const asked = [];
  page.on('request', (request) => asked.push(request.url()));
  await page.reload();
  await stageIs(page, 'contact');
  for (const url of asked) assert.ok(url.startsWith(tools.site.address) || /^(data|blob):/.test(url), url);
});
