// Pages of other sites show a job in a frame where the daemon names them, and nowhere else.
import assert from 'node:assert/strict';
import { createServer } from 'node:http';
import { after, test } from 'node:test';
import { openPage, stage } from './browser.mjs';

let browser;
let job;
const daemon = stage(async (its) => {
  ({ browser } = its);
  job = (await daemon.call('Jobs/CreateJob', { case: await daemon.presetCase('hexagon-small') })).name;
});
const site = createServer((_, answer) => answer.writeHead(200, { 'Content-Type': 'text/html' })
  .end('<!doctype html><title>A dashboard</title>' +
    `<iframe width="900" height="600" src="${daemon.url}/${job}"></iframe>`));
await new Promise((resolve) => site.listen(0, '127.0.0.1', resolve));
after(() => site.close());
const origins = ['localhost', '127.0.0.1'].map((host) => `http://${host}:${site.address().port}`);

/** What a page of an origin has in its frame: "the job", with its stream, or why browser or daemon refuse it. */
async function framedBy(origin) {
  const { page, errors, complaints } = await openPage(browser);
  await page.goto(origin);
  const frame = page.frameLocator('iframe');
  const job = frame.getByText('succeeded').first();
  for (let i = 0; i < 100 && !complaints.length && !await job.isVisible(); ++i) await page.waitForTimeout(100);
  await page.waitForTimeout(500);
  const isShown = await job.isVisible() && await frame.locator('[data-state=live]').isVisible();
  await page.close();
  return [isShown ? 'the job' : '', ...errors, ...complaints].join('');
}

test('without the option no site frames the page', async () => {
  for (const origin of origins) assert.match(await framedBy(origin), /frame-ancestors|403/);
});

test('a named site frames a job, which works there, and another one does not', async () => {
  await daemon.stop();
  await daemon.start(['--allow-framing', origins[0]]);
  assert.equal(await framedBy(origins[0]), 'the job');
  assert.match(await framedBy(origins[1]), /frame-ancestors/);
});
