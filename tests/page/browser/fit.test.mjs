// The picture of a crush is as high as the lattice is at present, shows all of it, and moves no control.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { stage } from './browser.mjs';

let page;
let errors;
const jobs = {};
const daemon = stage(async (its) => {
  ({ page, errors } = its);
  for (const direction of ['X', 'Y']) {
    const submitted = await daemon.presetCase('hexagon-small', (each) => {
      Object.assign(each.loading, { direction, speedMPerS: 60, endStrain: 0.7 });
      each.lattice.hexagon.columns = 8;
    });
    jobs[direction] = (await daemon.call('Jobs/CreateJob', { case: submitted })).name;
  }
  await page.goto(`${daemon.url}/${jobs.Y}`);
  await page.getByText('succeeded').first().waitFor();
});

// Where the walls are drawn in their canvas: shares of its width and height.
const drawn = () => page.locator('.picture canvas').first().evaluate((canvas) => {
  const { data, width, height } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  const box = { left: width, right: 0, top: height, bottom: 0 };
  for (let i = 3, at = 0; i < data.length; i += 4, ++at) {
    if (!data[i]) continue;
    const [x, y] = [at % width, Math.floor(at / width)];
    Object.assign(box, { left: Math.min(box.left, x), right: Math.max(box.right, x + 1),
                         top: Math.min(box.top, y), bottom: Math.max(box.bottom, y + 1) });
  }
  return { left: box.left / width, right: box.right / width, top: box.top / height, bottom: box.bottom / height };
});

async function show(path, strain) {
  await page.goto(`${daemon.url}/${path}`);
  await page.getByText(`strain ${strain}`).first().waitFor();
  await page.waitForTimeout(1200);
}

test('a crush along y leaves no half of its box empty, and the player stays where it is', async () => {
  await page.setViewportSize({ width: 700, height: 1000 });
  for (const path of [`${jobs.Y}?strain=0`, `compare?jobs=${jobs.Y.slice(5)}&strain=0`]) {
    await show(path, '0.000');
    const [picture, player] = [page.locator('.picture'), page.locator('.player')];
    const [before, bar] = [await picture.boundingBox(), await player.boundingBox()];
    await page.getByRole('slider').focus();
    await page.keyboard.press('End');
    await page.getByText('strain 0.70').first().waitFor();
    await page.waitForTimeout(1500);
    const after = await picture.boundingBox();
    assert.ok(after.height < 0.7 * before.height, `${path}: ${before.height} to ${after.height}`);
    assert.deepEqual(await player.boundingBox(), bar, path);
    const { top, bottom } = await drawn();
    assert.ok(bottom - top > 0.5, `${path}: ${top} to ${bottom}`);
  }
});

test('walls that bulge are not cut on a phone', async () => {
  await page.setViewportSize({ width: 390, height: 844 });
  for (const direction of ['X', 'Y']) {
    await show(`${jobs[direction]}?strain=0.7`, '0.70');
    const box = await drawn();
    assert.ok(Math.min(box.left, box.top, 1 - box.right, 1 - box.bottom) > 0.003, JSON.stringify(box));
    assert.ok(Math.max(box.right - box.left, box.bottom - box.top) > 0.3, JSON.stringify(box));
  }
});

test('no script has failed', () => assert.deepEqual(errors, []));
