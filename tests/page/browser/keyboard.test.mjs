// Everything by keyboard alone: a case is changed and started, its crush scrubbed, and two jobs are compared.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { paintedShare, axeFindings, stage } from './browser.mjs';

let page;
let errors;
const daemon = stage(async (its) => {
  ({ page, errors } = its);
  await page.goto(daemon.url + '/');
});

/** Presses Tab until the focus is on what a locator finds; says where it has been if it never is. */
async function tabTo(locator) {
  const passed = [];
  for (let i = 0; i < 150; ++i) {
    await page.keyboard.press('Tab');
    const focused = await page.evaluateHandle(() => document.activeElement);
    const isThere = await locator.first().evaluate((each, active) => each === active, focused).catch(() => false);
    if (isThere) {
      const outline = await focused.evaluate((each) => getComputedStyle(each).outlineStyle);
      assert.notEqual(outline, 'none', 'the focus is to be seen');
      return;
    }
    passed.push(await focused.evaluate((each) => each.textContent?.slice(0, 30) || each.getAttribute('aria-label')));
  }
  assert.fail(`never reached ${locator}, but ${passed.join(', ')}`);
}

async function startJob() {
  await tabTo(page.getByRole('link', { name: 'New case' }));
  await page.keyboard.press('Enter');
  await page.waitForURL('**/new*');
  await page.getByRole('button', { name: 'Start the job' }).waitFor();
  await tabTo(page.getByRole('button', { name: 'Start the job' }));
  await page.keyboard.press('Enter');
  await page.waitForURL('**/jobs/*');
  await page.getByText('succeeded').first().waitFor();
}

test('two jobs are started', async () => {
  await startJob();
  await startJob();
});

test('a crush is scrubbed and played', async () => {
  await tabTo(page.getByRole('slider'));
  await page.keyboard.press('Home');
  await page.getByText('strain 0.000').first().waitFor();
  await page.keyboard.press('End');
  await page.waitForFunction(() => !document.body.textContent.includes('strain 0.000'));
  await page.keyboard.press('Home');
  await page.keyboard.press('Space');
  await page.getByRole('button', { name: 'Pause (space)' }).waitFor();
  await page.keyboard.press('Space');
  await page.getByRole('button', { name: 'Play (space)' }).waitFor();
});

test('two jobs are compared at one strain', async () => {
  await tabTo(page.getByRole('link', { name: 'Jobs' }));
  await page.keyboard.press('Enter');
  for (const job of [2, 1]) {
    await tabTo(page.getByLabel(`Select job ${job} to compare`));
    await page.keyboard.press('Space');
  }
  await page.keyboard.press('Home');
  await tabTo(page.getByRole('button', { name: 'Compare' }));
  await page.keyboard.press('Enter');
  await page.waitForURL('**/compare?jobs=2,1*');
  await page.waitForTimeout(800);
  const pictures = await page.locator('.picture').all();
  assert.equal(pictures.length, 2);
  await tabTo(page.getByRole('slider'));
  await page.keyboard.press('Home');
  for (let i = 0; i < 100; ++i) await page.keyboard.press('ArrowRight');
  await page.waitForTimeout(500);
  for (const picture of pictures) assert.ok(await paintedShare(page, picture) > 0.02);
  assert.deepEqual(await axeFindings(page), []);
});

test('no script has failed', () => assert.deepEqual(errors, []));
