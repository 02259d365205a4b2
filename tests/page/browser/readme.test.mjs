// The pictures of the README are what the programs draw today. CELLCRUSH_WRITE_PAGES=1 writes them again.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { copyFileSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { meanDifference, openPage, stage } from './browser.mjs';

// Times of day and of the solver differ between two runs.
const tolerance = 0.005;
let browser;
const daemon = stage((its) => ({ browser } = its));

async function crush(preset) {
  const { name } = await daemon.call('Jobs/CreateJob', { case: await daemon.presetCase(preset) });
  const arguments_ = ['watch', name, '--server', `unix:${join(daemon.folder, 's')}`];
  execFileSync(process.env.CELLCRUSH, arguments_, { stdio: 'ignore' });
  return name;
}

async function expectPicture(made, committed) {
  const file = join(process.env.SOURCES, '../../..', committed);
  if (process.env.CELLCRUSH_WRITE_PAGES) copyFileSync(made, file);
  const { difference } = await meanDifference(browser, readFileSync(made), readFileSync(file));
  assert.ok(difference < tolerance, `${committed} is out of date (${difference}): run with CELLCRUSH_WRITE_PAGES=1`);
}

test('the picture of a crush is what plot draws', async () => {
  const made = join(daemon.folder, 'crush.png');
  const arguments_ = ['plot', await crush('hexagon-small'), '--wide', '-o', made];
  execFileSync(process.env.CELLCRUSH, [...arguments_, '--server', `unix:${join(daemon.folder, 's')}`]);
  await expectPicture(made, 'client-cli/pictures/hexagon-small.png');
});

test('the picture of the web page is what a browser shows', async () => {
  const made = join(daemon.folder, 'job.png');
  const { page } = await openPage(browser);
  await page.goto(`${daemon.url}/${await crush('type-i')}?strain=0.4`);
  await page.getByText('What was modelled').waitFor();
  await page.getByText('strain 0.400').first().waitFor();
  await page.waitForTimeout(1000);
  await page.screenshot({ path: made, fullPage: true });
  await expectPicture(made, 'server/page/pictures/job.png');
});
