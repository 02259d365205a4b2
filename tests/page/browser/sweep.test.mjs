// Sweeps over the speed: several in one chart, and their crushes side by side at equal strain.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { paintedShare, axeFindings, stage } from './browser.mjs';

let page;
let errors;
let complaints;
const daemon = stage(async (its) => {
  ({ page, errors, complaints } = its);
  const speed = 'loading.speed_m_per_s';
  await createSweep('Thin walls', speed, [50, 100, 150]);
  await createSweep('<b>Thick walls</b>', speed, [60, 120]);
  await createSweep('Thicknesses', 'lattice.hexagon.wall_thickness_mm', [0.3, 0.4]);
  await createSweep('Speeds and thicknesses', speed, [50, 100],
    [{ field: 'lattice.hexagon.wall_thickness_mm', list: { values: [0.3, 0.4] } }]);
  await createSweep('Three fields', speed, [50, 100],
    ['wall_thickness_mm', 'side_mm'].map((name, i) =>
      ({ field: `lattice.hexagon.${name}`, list: { values: [[0.3, 0.4], [4, 5]][i] } })));
  for (const id of [1, 2, 3, 4, 5]) await endOf(`sweeps/${id}`);
});

async function createSweep(title, field, values, more = []) {
  const swept = await daemon.presetCase('hexagon-small', (each) => {
    each.title = title;
    each.lattice.hexagon.columns = 10;
    each.loading.endStrain = 0.45;
  });
  const sweep = { case: swept, axes: [{ field, list: { values } }, ...more] };
  return daemon.call('Sweeps/CreateSweep', { sweep });
}

async function endOf(name) {
  for (let i = 0; i < 600; ++i) {
    const { stateCounts, jobs } = await daemon.call('Sweeps/GetSweep', { name });
    if (stateCounts.SUCCEEDED === jobs.length) return;
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
  throw new Error(`${name} does not end`);
}

test('another sweep over the same field joins the chart, and the address holds it', async () => {
  await page.goto(`${daemon.url}/sweeps/1`);
  const choice = page.getByLabel('Add a sweep to the chart');
  await choice.selectOption('sweeps/2');
  const legend = page.locator('.sweep-page .legend');
  await legend.getByText('Thin walls').waitFor();
  await legend.getByText('<b>Thick walls</b>').waitFor();
  const outlines = await legend.locator('svg.mark path').evaluateAll((marks) =>
    marks.map((mark) => mark.getAttribute('d')));
  assert.equal(new Set(outlines).size, 2, 'the marks differ');
  await page.waitForFunction(() => location.search.includes('with=2'));
  await page.reload();
  await legend.getByText('<b>Thick walls</b>').waitFor();
});

test('a sweep over another field is refused with the reason', async () => {
  const option = page.locator('option[value="sweeps/3"]');
  assert.match(await option.textContent(), /varies wall thickness \(mm\), not speed \(m\/s\)/);
  assert.ok(await option.isDisabled());
  await page.goto(`${daemon.url}/sweeps/1?with=2,3`);
  await page.getByText('varies wall thickness (mm), not speed (m/s).').waitFor();
  assert.equal(await page.locator('.sweep-page .legend .entry').count(), 2);
  await page.getByRole('button', { name: 'Remove sweep 3' }).click();
  await page.waitForFunction(() => location.search === '?with=2');
});

test('the crushes of a sweep stand side by side at the strain of one slider', async () => {
  const cells = page.locator('.crush-cell');
  assert.equal(await cells.count(), 3);
  for (const words of ['speed 50 m/s', 'speed 100 m/s', 'speed 150 m/s']) await cells.getByText(words).waitFor();
  await page.waitForFunction(() =>
    [...document.querySelectorAll('.crush-cell .picture-note')].every((note) => note.hidden));
  const picture = page.locator('.small-picture').first();
  assert.ok(await paintedShare(page, picture) > 0.05);
  await page.getByRole('slider').focus();
  await page.keyboard.press('Home');
  await page.getByText('strain 0.00').waitFor();
  const before = await picture.screenshot();
  for (let i = 0; i < 20; ++i) await page.keyboard.press('ArrowRight');
  await page.getByText('strain 0.20').waitFor();
  assert.notDeepEqual(await picture.screenshot(), before);
  await page.waitForFunction(() => location.search.includes('strain=0.2'));
  assert.match(await cells.first().getByRole('link').getAttribute('href'), /^\/jobs\/1\?strain=0\.2/);
});

test('a drag and the wheel zoom the chart, a double click shows all, and its scales change', async () => {
  const plot = page.locator('.sweep-page .u-over');
  const all = page.getByRole('button', { name: 'Show all' });
  await plot.scrollIntoViewIfNeeded();
  const { x, y, width, height } = await plot.boundingBox();
  for (const zoom of [async () => {
    await page.mouse.move(x + 0.5 * width, y + 0.2 * height);
    await page.mouse.down();
    await page.mouse.move(x + 0.9 * width, y + 0.8 * height, { steps: 3 });
    await page.mouse.up();
  }, async () => {
    await page.mouse.move(x + 0.5 * width, y + 0.5 * height);
    await page.mouse.wheel(0, -300);
  }, () => plot.press('+')]) {
    await zoom();
    await all.waitFor();
    await plot.dblclick({ position: { x: 4, y: 4 } });
    await all.waitFor({ state: 'hidden' });
  }
  const before = await plot.screenshot();
  await page.getByLabel('Scales').selectOption('log x and y');
  assert.notDeepEqual(await plot.screenshot(), before);
  await page.getByLabel('Measure of the chart').selectOption('Absorbed energy');
  await page.locator('.sweep-page figure h2', { hasText: 'Absorbed energy' }).waitFor();
});

test('a point of the chart leads to its job', async () => {
  await page.goto(`${daemon.url}/sweeps/1`);
  const plot = page.locator('.sweep-page .u-over');
  await plot.waitFor();
  const { x, y, width, height } = await plot.boundingBox();
  const tip = page.locator('.point-tip');
  for (let down = 4; down < height && !await tip.isVisible(); down += 8) {
    await page.mouse.move(x + (100 / 155) * width, y + down); // 100 m/s on an axis from 0 to 155
    await page.waitForTimeout(20);
  }
  assert.match(await tip.textContent(), /job 2/);
  await page.mouse.down();
  await page.mouse.up();
  await page.waitForURL('**/jobs/2');
  await page.goto(`${daemon.url}/sweeps/1?with=2`);
  await page.locator('.sweep-page .legend').getByText('Thick').waitFor();
});

test('a sweep over two fields has a map, whose cells lead to their jobs', async () => {
  await page.goto(`${daemon.url}/sweeps/4`);
  const map = page.locator('.sweep-map');
  await map.getByText('Impact plateau, MPa').waitFor();
  const { rows } = await daemon.call('Sweeps/GetSweepTable', { name: 'sweeps/4' });
  // From the top: thick walls, then thin ones; the sweep varies the thickness fastest.
  const wanted = [1, 3, 0, 2].map((i) => rows[i]);
  assert.deepEqual(await map.locator('td a').evaluateAll((links) => links.map((link) => [link.pathname.slice(1),
    link.textContent])), wanted.map(({ job, result }) => [job, result.summary.plateauStressImpactMpa.toPrecision(3)]));
  const labels = await map.locator('.contours text').allTextContents();
  assert.ok(labels.length > 0);
  const plateaus = rows.map(({ result }) => result.summary.plateauStressImpactMpa);
  for (const level of labels.map(Number)) {
    assert.ok(level > Math.min(...plateaus) && level < Math.max(...plateaus), `${level} of ${plateaus}`);
  }
  assert.deepEqual(await axeFindings(page), []);
  await page.goto(`${daemon.url}/sweeps/1?with=2`);
  await page.locator('.sweep-page .legend').getByText('Thick').waitFor();
  assert.equal(await map.isVisible(), false, 'one field is no map');
});

test('of a sweep over three fields the map has two that are chosen, and holds the third', async () => {
  await page.goto(`${daemon.url}/sweeps/5`);
  const map = page.locator('.sweep-map');
  const { fields, rows } = await daemon.call('Sweeps/GetSweepTable', { name: 'sweeps/5' });
  const [speed, thickness, side] = [0, 1, 2];
  const jobs = () => map.locator('td a').evaluateAll((links) => links.map((link) => link.pathname.slice(1)));
  // By rows from the top; values grow to the right and upwards.
  const wanted = (x, y, held, value) => rows.filter(({ values }) => values[held] === value)
    .sort((a, b) => b.values[y] - a.values[y] || a.values[x] - b.values[x]).map(({ job }) => job);
  await map.getByText('Impact plateau, MPa').waitFor();
  assert.equal(fields.length, 3);
  assert.deepEqual(await jobs(), wanted(speed, thickness, side, 4));
  await map.getByLabel('side (mm)').selectOption('5');
  assert.deepEqual(await jobs(), wanted(speed, thickness, side, 5));
  await map.getByLabel('across').selectOption('wall thickness (mm)');
  assert.deepEqual(await jobs(), wanted(thickness, speed, side, 5), 'the axes change places');
  await map.getByLabel('up').selectOption('side (mm)');
  assert.deepEqual(await jobs(), wanted(thickness, side, speed, 50));
  assert.deepEqual(await axeFindings(page), []);
  await page.goto(`${daemon.url}/sweeps/1?with=2`);
  await page.locator('.sweep-page .legend').getByText('Thick').waitFor();
});

test('the SVG of the chart has the curves of both sweeps', async () => {
  const download = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Save the chart' }).click();
  const chunks = [];
  for await (const chunk of await (await download).createReadStream()) chunks.push(chunk);
  const svg = Buffer.concat(chunks).toString();
  assert.match(svg, /Thin walls/);
  assert.match(svg, /&lt;b&gt;Thick walls/);
});

test('nothing stands in the way of people who cannot see or point', async () => {
  for (const colorScheme of ['light', 'dark']) {
    await page.emulateMedia({ colorScheme });
    await page.goto(`${daemon.url}/sweeps/1?with=2,3`);
    await page.waitForTimeout(2000);
    assert.deepEqual(await axeFindings(page), [], colorScheme);
  }
});

test('no script has failed', () => assert.deepEqual([...errors, ...complaints], []));
