// What a page shows stays whole and up to date: over a restart of the daemon, in many tabs, after a long sleep.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { openPage, stage } from './browser.mjs';
import { Daemon } from './daemon.mjs';

let browser;
const daemon = stage((its) => ({ browser } = its));

async function createJob(preset, change) {
  return (await daemon.call('Jobs/CreateJob', { case: await daemon.presetCase(preset, change) })).name;
}

/** The columns of a CSV file, by their names. */
function columnsOf(file) {
  const [names, ...rows] = readFileSync(file, 'utf8').trim().split(/\r?\n/).map((line) => line.split(','));
  return Object.fromEntries(names.map((name, column) => [name, rows.map((row) => Number(row[column]))]));
}

test('of a crush whose daemon is killed on the way, the page has the samples of result.h5, each once', async () => {
  const job = await createJob('type-i', (each) => (each.loading.endStrain = 0.6));
  const { page } = await openPage(browser);
  await page.goto(`${daemon.url}/${job}`);
  await page.getByText('running').first().waitFor();
  await page.waitForTimeout(1500);
  await daemon.stop('SIGKILL');
  await page.waitForTimeout(1500);
  await daemon.start();
  await page.getByText('succeeded').first().waitFor({ timeout: 240000 });
  const download = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Save all samples as a CSV file' }).first().click();
  const saved = join(daemon.folder, 'page.csv');
  await (await download).saveAs(saved);
  const server = 'unix:' + join(daemon.folder, 's');
  const fetched = join(daemon.folder, 'fetched');
  execFileSync(process.env.CELLCRUSH, ['--server', server, 'fetch', job, '-o', fetched], { stdio: 'pipe' });
  const [shown, stored] = [columnsOf(saved), columnsOf(join(fetched, 'history.csv'))];
  assert.ok(stored.time_s.length > 500, `${stored.time_s.length} samples`);
  for (const name of ['time_s', 'strain', 'stress_impact_mpa', 'stress_support_mpa', 'energy_plastic_mj']) {
    assert.deepEqual(shown[name], stored[name], name);
  }
  await page.close();
});

test('ten tabs follow a crush to its end, and one of them can start another', async () => {
  const job = await createJob('type-i', (each) => {
    each.lattice.hexagon.columns = 30;
    each.loading.endStrain = 0.4;
  });
  const context = await browser.newContext();
  const tabs = [];
  for (let i = 0; i < 10; ++i) {
    tabs.push(await context.newPage());
    await tabs[i].goto(`${daemon.url}/${job}`);
  }
  const last = tabs.pop();
  await last.goto(daemon.url + '/new');
  await last.getByRole('button', { name: 'Start the job' }).click();
  await last.waitForURL('**/jobs/*', { timeout: 15000 });
  for (const tab of [...tabs, last]) await tab.getByText('succeeded').first().waitFor({ timeout: 240000 });
  await context.close();
});

test('a tab that was asleep for an hour shows what has happened since', async () => {
  const { page } = await openPage(browser);
  const show = (hidden) =>
    page.evaluate((now) => {
      Object.defineProperty(document, 'hidden', { configurable: true, get: () => now });
      document.dispatchEvent(new Event('visibilitychange'));
    }, hidden);
  await page.clock.install();
  await page.goto(daemon.url + '/');
  await page.locator('a[href="/jobs/2"]').first().waitFor();
  await show(true);
  await page.clock.fastForward('01:00:00');
  const job = await createJob('hexagon-small', (each) => (each.title = 'while it slept'));
  await page.waitForTimeout(1000);
  assert.equal(await page.getByText('while it slept').count(), 0, 'a sleeping tab has no stream');
  await show(false);
  await page.getByText('while it slept').first().waitFor({ timeout: 15000 });
  assert.match(job, /jobs\/\d+/);
  await page.close();
});

test('a tab drops the jobs of a server in whose place another one has come, and deletes none of its jobs', async () => {
  const job = await createJob('hexagon-small', (each) => (each.title = 'FIRST'));
  const { page } = await openPage(browser);
  await page.goto(`${daemon.url}/${job}`);
  await page.getByRole('button', { name: 'Delete' }).first().click({ timeout: 60000 });
  await page.getByText('“FIRST” disappears').waitFor();
  const former = new Daemon();
  [former.folder, former.process, daemon.folder] = [daemon.folder, daemon.process, former.folder];
  await former.remove();
  await daemon.start();
  let last;
  do last = await createJob('hexagon-small', (each) => (each.title = 'SECOND')); while (last !== job);
  await page.getByRole('heading', { name: 'Another server answers here now' }).waitFor();
  assert.equal(await page.getByText('FIRST').count(), 0);
  assert.equal(await page.getByText('live', { exact: true }).count(), 0);
  assert.equal(await page.getByRole('dialog').count(), 0, 'the question went with its job');
  await page.getByRole('button', { name: 'Show the jobs of this server' }).click();
  await page.locator(`a[href="/${job}"]`).first().waitFor();
  assert.equal((await daemon.call('Jobs/GetJob', { name: job })).title, 'SECOND');
  await page.close();
});
