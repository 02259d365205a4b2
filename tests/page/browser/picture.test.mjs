// A GPU draws the same picture as the page does by itself.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { meanDifference, openPage, stage } from './browser.mjs';

let browser;
let job;
// WebGL2 in software, which the page does not use by itself.
const daemon = stage(async (its) => {
  ({ browser } = its);
  const submitted = await daemon.presetCase('hexagon-small', (each) => (each.loading.endStrain = 0.5));
  job = (await daemon.call('Jobs/CreateJob', { case: submitted })).name;
  await daemon.success(job);  // a page that is opened before shows the newest strain
}, ['--use-angle=swiftshader', '--enable-unsafe-swiftshader']);

/** A picture of the lattice, and how its walls were drawn: "webgl2" or "2d". */
async function drawn(renderer, place, colorScheme) {
  const { page, errors } = await openPage(browser);
  await page.emulateMedia({ colorScheme });
  await page.addInitScript((name) => {
    const { getParameter } = WebGL2RenderingContext.prototype;
    const kNames = [0x1f01, 0x9246];
    WebGL2RenderingContext.prototype.getParameter = function (asked) {
      return name && kNames.includes(asked) ? name : getParameter.call(this, asked);
    };
  }, renderer);
  await page.goto(`${daemon.url}/${job}?${place}`);
  await page.getByText('succeeded').first().waitFor();
  const pictureOf = () => page.locator('.picture').screenshot();
  // On a busy machine frames come late: the picture is taken once it has not changed for two seconds.
  let picture = await pictureOf();
  for (let same = 0; same < 4; ) {
    await page.waitForTimeout(500);
    const next = await pictureOf();
    same = next.equals(picture) ? same + 1 : 0;
    picture = next;
  }
  const kind = await page.evaluate(() => {
    const canvas = document.querySelector('.picture canvas');
    return canvas.getContext('2d') ? '2d' : canvas.getContext('webgl2') ? 'webgl2' : 'none';
  });
  assert.deepEqual(errors, []);
  await page.close();
  return { kind, picture };
}

test('with WebGL2 and with Canvas2D the lattice looks the same, whole and zoomed in', async () => {
  const cases = [['light', 'strain=0.3'], ['dark', 'strain=0.3&view=4,30,10']];
  for (const [colorScheme, place] of cases) {
    const byGpu = await drawn('A GPU', place, colorScheme);
    const byPage = await drawn('', place, colorScheme);
    assert.deepEqual([byGpu.kind, byPage.kind], ['webgl2', '2d']);
    const { difference, contrast } = await meanDifference(browser, byGpu.picture, byPage.picture);
    assert.ok(contrast > 0.02, `${colorScheme}, ${place}: ${contrast} of the picture is drawn`);
    assert.ok(difference < 0.04 * contrast, `${colorScheme}, ${place}: ${difference} of ${contrast}`);
    console.log(`${colorScheme}, ${place}: difference ${difference.toFixed(5)} of ${contrast.toFixed(4)}`);
  }
});
