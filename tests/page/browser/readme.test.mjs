// The pictures of the README are what the programs draw today, of the crush whose figures its text shows.
// CELLCRUSH_WRITE_PAGES=1 writes them again.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { copyFileSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { meanDifference, openPage, stage } from './browser.mjs';

// Times of day and of the solver differ between two runs.
const tolerance = 0.005;
const root = join(process.env.SOURCES, '../../..');
let browser;
let job;

function cellcrush(...arguments_) {
  const options = { env: { ...process.env, COLUMNS: '100' } };
  const server = `unix:${join(daemon.folder, 's')}`;
  return execFileSync(process.env.CELLCRUSH, [...arguments_, '--server', server], options).toString();
}

const daemon = stage(async (its) => {
  ({ browser } = its);
  ({ name: job } = await daemon.call('Jobs/CreateJob', { case: await daemon.presetCase('hexagon-small') }));
  cellcrush('watch', job);
});

async function expectPicture(made, committed) {
  const file = join(root, committed);
  if (process.env.CELLCRUSH_WRITE_PAGES) copyFileSync(made, file);
  const { difference } = await meanDifference(browser, readFileSync(made), readFileSync(file));
  assert.ok(difference < tolerance, `${committed} is out of date (${difference}): run with CELLCRUSH_WRITE_PAGES=1`);
}

test('the text of the README has the figures of the crush in its pictures', () => {
  const readme = readFileSync(join(root, 'README.md'), 'utf8').split('\n');
  for (const name of ['at the impact plate', 'energy ledger error', 'crush mode']) {
    const line = cellcrush('show', job).split('\n').find((each) => each.trim().startsWith(name));
    assert.ok(readme.includes(line), `README.md does not show "${line}"`);
  }
});

test('the picture of a crush is what plot draws', async () => {
  const made = join(daemon.folder, 'crush.png');
  cellcrush('plot', job, '--wide', '-o', made);
  await expectPicture(made, 'client-cli/pictures/hexagon-small.png');
});

test('the picture of the web page is what a browser shows', async () => {
  const made = join(daemon.folder, 'job.png');
  const { page } = await openPage(browser);
  await page.goto(`${daemon.url}/${job}?strain=0.4`);
  await page.getByText('What was modelled').waitFor();
  await page.getByText('strain 0.400').first().waitFor();
  await page.waitForTimeout(1000);
  await page.screenshot({ path: made, fullPage: true });
  await expectPicture(made, 'server/page/pictures/job.png');
});
