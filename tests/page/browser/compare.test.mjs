// The comparison tells in which of all fields the cases of jobs differ, and in which results.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { axeFindings, stage } from './browser.mjs';

let page;
let errors;
const jobs = [];
const daemon = stage(async (its) => {
  ({ page, errors } = its);
  for (const [speed, seed, title] of [[100, 1, 'one'], [120, 1, 'other'], [100, 1, 'one']]) {
    const submitted = await daemon.presetCase('hexagon-small', (each) => {
      Object.assign(each, { title, plates: { friction: speed / 1000 } });
      Object.assign(each.loading, { speedMPerS: speed, endStrain: 0.3 });
      each.lattice.imperfection = { amplitudeMm: 0.02, seed };
    });
    jobs.push((await daemon.call('Jobs/CreateJob', { case: submitted })).name);
  }
});

// The names of the rows of a group, "Case" or "Result".
const rowsOf = (group) => page.locator(`.compare-below tbody:has(th:text-is("${group}")) th[scope=row]`)
  .allTextContents();

async function compare(ids) {
  await page.goto(`${daemon.url}/compare?jobs=${ids}`);
  await page.getByRole('columnheader', { name: `job ${ids[0]}` }).waitFor();
  await daemon.success(jobs[2]);
}

// The page shows what it has while it asks for the rest.
async function eventually(check) {
  for (let tries = 1; ; ++tries) {
    try {
      return await check();
    } catch (error) {
      if (tries === 100) throw error;
      await page.waitForTimeout(100);
    }
  }
}

test('only the fields that differ are listed, or all', async () => {
  await compare([1, 2]);
  // The step is chosen by the speed.
  const fields = ['plates.friction', 'loading.speed_m_per_s', 'numerics.time_step_s'];
  await eventually(async () => assert.deepEqual(await rowsOf('Case'), fields));
  const steps = await page.locator('tr', { hasText: 'time_step_s' }).locator('td').allTextContents();
  for (const step of steps) assert.match(step, /^[\d.]{1,7}e-\d+$/, 'in six digits');
  const differing = await rowsOf('Result');
  assert.ok(differing.some((name) => name.startsWith('Absorbed energy')), differing.join());
  await page.getByLabel('all fields').check();
  const all = await rowsOf('Case');
  assert.ok(all.length > 15, all.join());
  assert.ok((await rowsOf('Result')).length > differing.length);
  assert.deepEqual(await axeFindings(page), []);
});

test('jobs of equal cases differ in nothing', async () => {
  await compare([1, 3]);
  await eventually(async () => {
    const names = [...await rowsOf('Case'), ...await rowsOf('Result')];
    assert.deepEqual(names.filter((name) => name !== 'Solver seconds'), []);
  });
});

test('no script has failed', () => assert.deepEqual(errors, []));
