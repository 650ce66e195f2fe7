// A whole insertion on both sources: what the page shows at every stage is what the native engine computes when its
// hand goes the same way.
import assert from 'node:assert/strict';
import { after, afterEach, before, test } from 'node:test';
import { endServers, nativeInsertion, serve } from './lib/program.mjs';
import { anew, begin, closePages, count, download, goesOn, openStudio, paused, picture, pixels, readings, rowsOf, stageIs, written } from './lib/studio.mjs';

// studies/fig6.toml, as the page's preset of it has it: buckles, goes in, buckles again.
const preset = 'fig6-clamped_pinned';
const scene = 'default';
const fig6 = {
  'needle.model': 'column',
  'needle.imperfection_mm': 0.05,
  'tissue.element': 'linear',
  'contact.rupture_force_N': 0.66,
  'contact.fracture_toughness_J_m2': 76,
  'contact.friction_N_m': 20,
  'hand.speed_mm_s': 4,
  'hand.travel_mm': 58, // half as far again a page lets it go
  'run.time_step_ms': 2,
  'run.solver_tolerance': 1e-6,
};
const coarse = { ...fig6, 'tissue.tetrahedra': 1000 };

let tools;
before(async () => (tools = await begin()));
afterEach(() => Promise.all([closePages(), endServers()]));
after(() => tools.end());

// What becomes of stopped time at each stage.
const stages = { contact: pushes, buckled: goesOn, inserted: goesOn, inserted_buckled: pulls, withdrawn: goesOn };
const told = [{ push: 0.4e-3 }, { steady: 0.02 }, { steady: -0.02 }, { steady: 0 }]; // the first touch and the end of the way by the page itself

// In slow motion: on a busy machine a stage would be over before it is seen and stopped.
async function pushes(page) {
  await page.selectOption('#rate', '0.25');
  await page.selectOption('#speed', '0.02');
  await picture(page).focus();
  await page.keyboard.press('s');
}
async function pulls(page) {
  await page.selectOption('#rate', '1');
  await picture(page).focus();
  await page.keyboard.press('w');
}

// From rest, pushes the needle in until it has buckled twice, pulls it out, and stops at each stage on the way.
async function thereAndBack(page) {
  const seen = [];
  await page.waitForFunction(() => Number.parseFloat(document.querySelector('[data-value=time_s]').textContent) > 1);
  for (const [stage, goOn] of Object.entries(stages)) {
    await stageIs(page, stage);
    const { time_s } = await paused(page);
    seen.push({ stage: await page.getAttribute('[data-stage]', 'data-stage'), time_s, shown: await readings(page) });
    await goOn(page);
  }
  return seen;
}

const happened = (page) => page.locator('.events span').evaluateAll((marks) => marks.map((mark) => mark.title));
const eventWords = { contact: 'Contact', buckling: 'Buckling', straightening: 'Straight again', puncture: 'Puncture', second_buckling: 'Second buckling', exit: 'Tip out' };

// A new insertion that touches the tissue in slow motion: the page sees each step of the glide there. Later the hand turns
// only where time is stopped. So its trace tells its whole way; what it does between two moments need not be guessed.
async function touchesSlowly(page, act) {
  await page.selectOption('#rate', '0.02');
  await anew(page, act);
  await page.selectOption('#rate', '1');
}

const haveTheSameBits = (trace, { rows }) => trace.forEach((row) => assert.deepEqual(row, rows.find(({ time_s }) => time_s === row.time_s)));

async function isTheNativeOne(page, seen) {
  const marks = await happened(page);
  const trace = rowsOf((await download(page, 'CSV')).bytes);
  const native = await nativeInsertion(scene, coarse, trace, told);
  haveTheSameBits(trace, native);
  for (const { stage, time_s, shown } of seen) {
    const row = native.rows.find((one) => one.time_s === time_s);
    assert.equal(stage, row.stage);
    assert.deepEqual(shown, written(row), stage);
  }
  assert.deepEqual(marks, native.events.map((event) => `${eventWords[event.event]}, ${written(event).hand_force_N}`));
  for (const event of ['contact', 'buckling', 'puncture', 'second_buckling', 'exit']) assert.ok(native.events.some((one) => one.event === event), event);
  for (const row of trace) {
    const found = row.energy_tissue_J + row.energy_needle_J + row.energy_kinetic_J + row.energy_contact_J + row.work_cutting_J + row.work_friction_J + row.work_damping_J + row.work_relaxation_J + row.work_numerical_J + row.work_snap_J + row.energy_residual_J;
    assert.ok(Math.abs(found - row.work_hand_J) < 1e-9 + 1e-9 * Math.abs(row.work_hand_J), 'the areas of the ledger add up to the work of the hand');
  }
}

test('in_the_page_it_is_the_native_engines_to_the_digit', async () => {
  const { page, complaints } = await openStudio(tools);
  await anew(page, () => page.selectOption('#scene', preset));
  await touchesSlowly(page, () => page.selectOption('#mesh', '1000'));
  await isTheNativeOne(page, await thereAndBack(page));
  assert.deepEqual(complaints, []);
});

test('at_a_server_it_is_the_native_engines_to_the_digit', async () => {
  const server = await serve(scene, coarse);
  const { page, complaints } = await openStudio(tools, { address: server.address });
  await touchesSlowly(page, () => page.getByRole('button', { name: 'Reset' }).click());
  await isTheNativeOne(page, await thereAndBack(page));
  assert.deepEqual(complaints, []);
  assert.equal(await server.end(), 0);
});

test('the_papers_ten_thousand_tetrahedra_open_run_and_are_drawn', async () => {
  const { page, complaints } = await openStudio(tools);
  await anew(page, () => page.selectOption('#scene', preset));
  await touchesSlowly(page, () => page.selectOption('#mesh', '10000'));
  await picture(page).focus();
  await page.keyboard.press('Shift+ArrowDown');
  await page.waitForFunction(() => Number.parseFloat(document.querySelector('[data-value=hand_travel_m]').textContent) >= 4.4);
  const { time_s } = await paused(page);
  const shown = await readings(page);
  const trace = rowsOf((await download(page, 'CSV')).bytes);
  const native = await nativeInsertion(scene, { ...fig6, 'tissue.tetrahedra': 10000 }, trace, [{ push: 0.4e-3 }, { push: 0.4e-3 + 4e-3 }]);
  haveTheSameBits(trace, native);
  assert.deepEqual(shown, written(native.rows.find((one) => one.time_s === time_s)));
  assert.ok(Number.parseFloat((await page.locator('.pace dd').textContent()).slice(1)) > 0, 'its pace is said');
  const drawn = await pixels(page);
  assert.ok(count(drawn, (r, g, b, a) => a > 200) > 0.03 * drawn.width * drawn.height, 'the picture is not blank');
  assert.deepEqual(complaints, []);
});
