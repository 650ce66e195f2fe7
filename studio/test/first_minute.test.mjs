// The first minute: what a person meets who never read the paper.
import assert from 'node:assert/strict';
import { after, afterEach, before, test } from 'node:test';
import { begin, closePages, count, openStudio, picture, pixels, stageIs } from './lib/studio.mjs';

let tools;
before(async () => (tools = await begin()));
afterEach(closePages);
after(() => tools.end());

test('it_opens_in_contact_on_the_papers_needle_and_says_what_to_do', async () => {
  const { page, complaints } = await openStudio(tools);
  assert.equal(await page.locator('#scene option:checked').textContent(), 'Fig. 7(a): 200 mm needle');
  assert.equal(await page.inputValue('#needle-length_mm'), '200');
  assert.match(await page.locator('.story').textContent(), /Push the needle\. Pull its hub down/);
  assert.match(await page.locator('[data-words]').textContent(), /0\.642 N.*1\.00 N.*will not go in/);
  assert.ok(await page.getByRole('button', { name: 'Steady hand' }).isEnabled());
  assert.match(await page.locator('.hint').textContent(), /pull the hub down/);
  assert.deepEqual(complaints, []);
});

test('one_key_buckles_it_and_the_page_says_why_and_what_would_help', async () => {
  const { page, complaints } = await openStudio(tools);
  await page.evaluate(() => {
    window.shifted = 0;
    new PerformanceObserver((list) => {
      for (const entry of list.getEntries()) if (!entry.hadRecentInput) window.shifted += entry.value;
    }).observe({ type: 'layout-shift', buffered: false });
  });
  await page.keyboard.press('s'); // the picture has the focus from the start
  await stageIs(page, 'buckled');
  const told = await page.locator('.story').textContent();
  assert.match(told, /It buckled\./);
  assert.match(told, /0\.64 N/);
  assert.match(told, /1\.00 N/);
  await page.waitForFunction(() => /Buckling at 0\.6[34]\d N/.test(document.querySelector('[data-said]').textContent));
  const drawn = await pixels(page);
  assert.ok(count(drawn, (r, g, b, a) => a > 200) > 0.03 * drawn.width * drawn.height, 'the picture is not blank');
  const offer = page.locator('.story button');
  assert.match(await offer.textContent(), /Try 150 mm, which stays straight/);
  await offer.click();
  await page.waitForFunction(() => /go in straight/.test(document.querySelector('[data-words]').textContent));
  await stageIs(page, 'contact');
  assert.equal(await page.locator('.earlier li').count(), 1, 'the first run stays to compare');
  await picture(page).focus();
  await page.keyboard.press('s');
  await stageIs(page, 'inserted');
  assert.match(await page.locator('.story').textContent(), /went in straight/);
  assert.ok((await page.evaluate(() => window.shifted)) < 0.02, 'nothing on the page jumps');
  assert.deepEqual(complaints, []);
});

test('an_engine_that_does_not_load_is_said_in_words', async () => {
  const { page } = await openStudio(tools, { ready: false, address: `${tools.site.address}` });
  await page.route('**/*.wasm', (route) => route.abort());
  await page.reload();
  await page.waitForFunction(() => /could not start/.test(document.querySelector('.story')?.textContent ?? ''));
});

test('a_page_that_is_loaded_again_in_the_middle_of_a_push_begins_anew', async () => {
  const { page, complaints } = await openStudio(tools);
  await page.keyboard.press('s');
  await stageIs(page, 'buckled');
  await page.reload();
  await stageIs(page, 'contact');
  assert.match(await page.locator('.story').textContent(), /Push the needle/);
  assert.equal(await page.locator('.events span').count(), 1, 'nothing is left of the push but a new contact');
  await page.keyboard.press('s');
  await stageIs(page, 'buckled');
  assert.deepEqual(complaints, []);
});
