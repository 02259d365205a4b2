// A job exported as one file, which is opened from disk when its daemon is gone.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { openPage, paintedShare, axeFindings, stage } from './browser.mjs';

const title = '</title></script><script>document.title = "broken out"</script>';
let browser;
let exported;
const daemon = stage((its) => ({ browser } = its));
const file = join(daemon.folder, 'crush.html');

test('an ended job is saved as a file', async () => {
  const submitted = await daemon.presetCase('hexagon-small', (each) => (each.title = title));
  const job = await daemon.call('Jobs/CreateJob', { case: submitted });
  const { page } = await openPage(browser);
  await page.goto(`${daemon.url}/${job.name}`);
  await page.getByText('succeeded').first().waitFor();
  const download = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Save this page as a file' }).click();
  await (await download).saveAs(file);
  await page.close();
});

test('the file shows the job without a daemon, and asks for nothing', async () => {
  const { summary } = await daemon.call('Jobs/GetJob', { name: 'jobs/1' });
  await daemon.stop();
  exported = await openPage(browser);
  const { page, errors, complaints, requests } = exported;
  await page.goto(pathToFileURL(file).href);
  await page.getByRole('heading', { name: title }).waitFor();
  await page.getByText(summary.plateauStressImpactMpa.toPrecision(3)).first().waitFor();
  await page.getByText('What was modelled').waitFor();
  await page.waitForTimeout(1000);
  assert.ok(await paintedShare(page, page.locator('.picture')) > 0.02, 'the lattice');
  for (const plot of await page.locator('.plot').all()) assert.ok(await paintedShare(page, plot) > 0.02, 'a curve');
  assert.equal(await page.title(), `${title} – cellcrush`);
  assert.equal(await page.locator('a[href]').count(), 0);
  assert.equal(await page.getByRole('button', { name: 'Delete' }).count(), 0);
  assert.deepEqual(requests.filter((url) => !url.startsWith('data:')), [pathToFileURL(file).href]);
  assert.deepEqual([...errors, ...complaints], []);
});

test('its crush is scrubbed and played, and the address holds the place', async () => {
  const { page } = exported;
  await page.getByRole('slider').first().focus();
  await page.keyboard.press('Home');
  await page.getByText('strain 0.000').first().waitFor();
  for (let i = 0; i < 10; ++i) await page.keyboard.press('ArrowRight');
  const place = await page.locator('output.place').textContent();
  await page.waitForFunction((shown) => {
    const strain = Number(new URLSearchParams(location.hash.slice(1)).get('strain'));
    return strain > 0 && shown === `strain ${strain.toFixed(3)}`;
  }, place);
  await page.reload();
  await page.getByText(place).first().waitFor();
  await page.getByRole('button', { name: 'Play (space)' }).click();
  await page.waitForFunction((before) => document.querySelector('output.place').textContent > before, place);
});

test('its picture, curves and samples can be saved from it', async () => {
  const { page } = exported;
  for (const name of ['Save this picture', 'Save the chart', 'Save all samples']) {
    const download = page.waitForEvent('download');
    await page.getByRole('button', { name }).first().click();
    await download;
  }
  assert.equal(await page.getByRole('button', { name: 'Save the result file' }).count(), 0);
  assert.deepEqual([...exported.errors, ...exported.complaints], []);
});

test('nothing stands in the way of people who cannot see or point', async () => {
  const { page } = exported;
  for (const colorScheme of ['light', 'dark']) {
    await page.emulateMedia({ colorScheme });
    await page.waitForTimeout(500);
    assert.deepEqual(await axeFindings(page), [], colorScheme);
  }
});
