// The list: sweeps with their jobs folded in, columns to sort by and to choose.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { axeFindings, stage } from './browser.mjs';

let page;
let errors;
const speeds = [100, 50, 150];
const daemon = stage(async (its) => {
  ({ page, errors } = its);
  const swept = await daemon.presetCase('type-i', (each) => {
    each.title = 'Three speeds';
    each.lattice.hexagon.columns = 64;
    each.loading.endStrain = 0.45;
  });
  const axes = [{ field: 'loading.speed_m_per_s', list: { values: speeds } }];
  await daemon.call('Sweeps/CreateSweep', { sweep: { case: swept, axes } });
  await page.goto(daemon.url + '/');
});

const inside = () => page.locator('.inside table');
const column = async (place) => (await inside().locator(`tbody td:nth-child(${place})`).allTextContents()).map(Number);

test('a sweep unfolds its jobs, whose running ones show progress and the plateau so far', async () => {
  await page.getByRole('button', { name: 'Jobs of sweep 1' }).click();
  await inside().locator('tbody tr').nth(speeds.length - 1).waitFor();
  assert.deepEqual(await column(1), speeds);
  assert.equal(await page.getByRole('link', { name: 'Three speeds' }).count(), 1, 'its jobs are not in the list');
  await inside().locator('progress').first().waitFor();
  await inside().locator('.so-far').first().waitFor();
  await page.locator('.states .under', { hasText: '3 succeeded' }).waitFor({ timeout: 240000 });
  assert.equal(await inside().locator('.so-far').count(), 0);
});

test('a click on a head sorts up, down, and not', async () => {
  const head = inside().getByRole('button', { name: 'speed (m/s)' });
  for (const wanted of [[50, 100, 150], [150, 100, 50], speeds]) {
    await head.click();
    assert.deepEqual(await column(1), wanted);
  }
});

test('chosen columns stay chosen', async () => {
  const head = page.getByRole('columnheader', { name: 'Deepest penetration' });
  assert.equal(await head.count(), 0);
  await page.locator('.inside summary:visible').click();
  await page.getByLabel('Deepest penetration').first().check();
  await head.waitFor();
  await page.reload();
  await page.getByRole('button', { name: 'Jobs of sweep 1' }).click();
  await head.waitFor();
  assert.deepEqual(await axeFindings(page), []);
});

test('no script has failed', () => assert.deepEqual(errors, []));
