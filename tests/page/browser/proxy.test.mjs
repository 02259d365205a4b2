// The page behind proxies: below a path of another site, over cut streams, and where answers come only as a whole.
import assert from 'node:assert/strict';
import { createServer, request } from 'node:http';
import { after, test } from 'node:test';
import { openPage, stage } from './browser.mjs';

let browser;
const daemon = stage((its) => ({ browser } = its));
const proxies = [];
after(() => proxies.forEach((proxy) => proxy.closeAllConnections()));
after(() => proxies.forEach((proxy) => proxy.close()));

/** A site that passes on what lies below a path, with or without the path, under the daemon's address as Host. */
async function site(path, { keepsPath = false, isWhole = false } = {}) {
  const proxy = createServer((asked, answer) => {
    if (!asked.url.startsWith(path)) return answer.writeHead(404).end();
    const headers = { ...asked.headers, host: `127.0.0.1:${daemon.port}` };
    const target = keepsPath ? asked.url : asked.url.slice(path.length);
    const onward = request(daemon.url + target, { method: asked.method, headers }, (got) => {
      const parts = [];
      const begin = () => answer.writeHead(got.statusCode, got.headers);
      if (!isWhole) return begin(), got.pipe(answer);
      got.on('data', (part) => parts.push(part)).on('end', () => begin().end(Buffer.concat(parts)));
    });
    onward.on('error', () => answer.destroy());
    answer.on('close', () => onward.destroy());
    asked.pipe(onward);
  });
  proxies.push(proxy);
  await new Promise((resolve) => proxy.listen(0, '127.0.0.1', resolve));
  return { proxy, url: `http://127.0.0.1:${proxy.address().port}${path}` };
}

/** Starts a job on the page, and follows links from it and back. */
async function use(url) {
  const { page, errors, complaints } = await openPage(browser);
  await page.goto(`${url}/new`);
  await page.getByRole('button', { name: 'Start the job' }).click();
  await page.waitForURL(`${url}/jobs/*`, { timeout: 15000 });
  await page.getByText('succeeded').first().waitFor({ timeout: 60000 });
  await page.reload();
  await page.getByRole('link', { name: 'Jobs', exact: true }).click();
  await page.waitForURL(`${url}/`);
  await page.locator(`a[href="${new URL(url).pathname}/jobs/1"]`).first().waitFor();
  assert.deepEqual([...errors, ...complaints], []);
  return page;
}

test('a proxy takes its path off, and a cut that the page mends at once is no alarm', async () => {
  const { proxy, url } = await site('/node/host/8080');
  await daemon.stop();
  await daemon.start(['--public-url', url]);
  const page = await use(url);
  const states = await page.evaluate(() => {
    const status = document.querySelector('.connection');
    window.seen = [];
    new MutationObserver(() => window.seen.push(status.dataset.state)).observe(status, { attributes: true });
    return [status.dataset.state];
  });
  for (let i = 0; i < 2; ++i) {
    proxy.closeAllConnections();
    await page.waitForTimeout(2000);
  }
  const title = 'created after the cuts';
  const change = (each) => (each.title = title);
  await daemon.call('Jobs/CreateJob', { case: await daemon.presetCase('hexagon-small', change) });
  await page.getByText(title).first().waitFor({ timeout: 10000 });
  assert.deepEqual([...states, ...await page.evaluate(() => window.seen)].filter((each) => each !== 'live'), []);
  await page.close();
});

test('a proxy passes its path on, and answers only as a whole', async () => {
  const { url } = await site('/proxy/absolute/8080', { keepsPath: true, isWhole: true });
  await daemon.stop();
  await daemon.start(['--public-url', url + '/']);
  await (await use(url)).close();
});
