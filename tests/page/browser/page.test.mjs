// The web page in Debian's Chromium, against a real daemon that crushes real scenes.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { axeFindings, settledShare, stage } from './browser.mjs';

let page;
let errors;
const daemon = stage((its) => ({ page, errors } = its));

test('a job started from the form is watched to its end', async () => {
  await page.goto(daemon.url + '/new');
  await page.getByRole('button', { name: 'Start the job' }).click();
  await page.waitForURL('**/jobs/1');
  await page.getByText('succeeded').first().waitFor();
  await page.locator('canvas').first().waitFor();
  const { summary } = await daemon.call('Jobs/GetJob', { name: 'jobs/1' });
  const shown = summary.plateauStressImpactMpa.toPrecision(3);
  await page.getByText(shown).first().waitFor();
});

test('the crush is scrubbed by the keyboard, and the address holds the place', async () => {
  const slider = page.getByRole('slider').first();
  await slider.focus();
  await page.keyboard.press('Home');
  await page.getByText('strain 0.000').first().waitFor();
  for (let i = 0; i < 10; ++i) await page.keyboard.press('ArrowRight');
  await page.waitForFunction(() => /strain=0\.[0-9]*[1-9]/.test(location.href));
});

test('a title is text, also when it is a script', async () => {
  const title = '<img src=x onerror="document.title=1">';
  const submitted = await daemon.presetCase('hexagon-small', (each) => (each.title = title));
  const job = await daemon.call('Jobs/CreateJob', { case: submitted });
  await page.goto(`${daemon.url}/${job.name}`);
  await page.getByText(title).first().waitFor();
  assert.equal(await page.locator('img[src=x]').count(), 0);
});

test('a file dropped on the curves of a job is laid over them', async () => {
  const { samples } = await daemon.call('Jobs/GetHistory', { name: 'jobs/1', pageSize: 100000 });
  const rows = samples.map(({ strain = 0, stressSupportMpa = 0 }) => `${100 * strain};${0.5 * stressSupportMpa}`);
  await page.goto(daemon.url + '/jobs/1');
  await page.locator('canvas').first().waitFor();
  const drop = async (text) => {
    const files = await page.evaluateHandle((content) => {
      const data = new DataTransfer();
      data.items.add(new File([content], 'own.csv', { type: 'text/csv' }));
      return data;
    }, text);
    const curves = page.locator('section.card', { hasText: 'Stress and strain' });
    await curves.dispatchEvent('drop', { dataTransfer: files });
  };
  await drop(['Dehnung (%);Spannung (MPa)', ...rows].join('\n').replaceAll('.', ','));
  const energy = page.getByRole('row', { name: /^energy to/ });
  await energy.getByText('+100 %').waitFor();
  await drop('a;b\n1;2\n2;3\n3;4\n');
  await page.getByText('has no column that is strain or displacement').waitFor();
  assert.equal(await energy.count(), 0);
});

test('a sweep over two fields with labels is started from the form', async () => {
  await page.goto(daemon.url + '/new');
  await page.getByLabel('a sweep').check();
  await page.getByLabel('Values').fill('80, 160');
  await page.getByRole('button', { name: 'Vary another field' }).click();
  await page.getByLabel('Values').last().fill('seeds:2');
  await page.getByText('Note, labels and priority').click();
  await page.getByLabel('Labels').fill('series');
  await page.getByText('“series” is not key=value').waitFor();
  await page.getByLabel('Labels').fill('series=form');
  await page.getByLabel('Priority').fill('7');
  await page.getByRole('button', { name: 'Start 4 jobs' }).click();
  await page.waitForURL('**/sweeps/1');
  const sweep = await daemon.call('Sweeps/GetSweep', { name: 'sweeps/1' });
  assert.deepEqual(sweep.axes.map(({ field }) => field), ['loading.speed_m_per_s', 'lattice.imperfection.seed']);
  assert.equal(sweep.jobs.length, 4);
  assert.deepEqual(sweep.labels, { series: 'form' });
  assert.equal(sweep.priority, 7);
  // It fills in while its jobs end, without a reload.
  for (const name of sweep.jobs) {
    let job = {};
    while (job.state !== 'SUCCEEDED') {
      await page.waitForTimeout(100);
      job = await daemon.call('Jobs/GetJob', { name });
    }
    await page.getByRole('cell', { name: job.summary.plateauStressImpactMpa.toPrecision(3) }).first().waitFor();
  }
  // The seeds are averaged, unless each is wanted.
  await page.getByRole('link', { name: '2 of 2' }).nth(1).waitFor();
  const rows = page.locator('.sweep-page .rows:visible tbody tr');
  assert.equal(await rows.count(), 2);
  await page.getByLabel('each seed').check();
  assert.equal(await rows.count(), 4);
});

// A field of a message in protobuf's binary form.
function field(number, bytes) {
  return Buffer.concat([Buffer.from([(number << 3) | 2, bytes.length]), Buffer.from(bytes)]);
}

test('the form asks for an executor where there are several, and sends it', async () => {
  await page.goto(daemon.url + '/new');
  await page.getByRole('button', { name: 'Start the job' }).and(page.locator(':enabled')).waitFor();
  assert.equal(await page.getByLabel('Executor').isVisible(), false);
  const another = field(6, field(1, Buffer.from('slurm/a')));
  const address = '**/cellcrush.v1.Admin/GetCapabilities';
  await page.route(address, async (route) => {
    const response = await route.fetch();
    await route.fulfill({ response, body: Buffer.concat([await response.body(), another]) });
  });
  await page.goto(daemon.url + '/new');
  await page.getByLabel('Executor').waitFor();
  assert.equal(await page.getByLabel('Executor').inputValue(), 'local');
  await page.getByLabel('Executor').selectOption('slurm/a');
  await page.getByRole('button', { name: 'Start the job' }).click();
  await page.getByText('executor is "slurm/a"; this daemon has local.').waitFor();
  await page.unroute(address);
});

test('the rigid wall of a frame is in its picture', async () => {
  const plate = '#5b616c';
  const shares = [];
  for (const rigidWalls of [[], [{ id: 'w', xMm: 10.5, yMm: 0, normalX: -1 }]]) {
    const submitted = await daemon.presetCase('hexagon-small', (each) => {
      each.lattice = { frame: {
        nodes: [{ id: 'a', xMm: 0, yMm: 0 }, { id: 'b', xMm: 10, yMm: 8 }],
        beams: [{ start: 'a', end: 'b', thicknessMm: 0.5, elements: 8 }],
        supports: [{ node: 'a', fixX: true, fixY: true, fixRotation: true }],
        rigidWalls,
        endTimeS: 0.001,
      } };
      delete each.loading;
      delete each.plates;
    });
    const job = await daemon.call('Jobs/CreateJob', { case: submitted });
    await page.goto(`${daemon.url}/${job.name}`);
    await page.getByText('succeeded').first().waitFor();
    await page.waitForFunction(() => document.querySelector('.picture-note').hidden);
    shares.push(await settledShare(page, page.locator('.picture'), plate));
  }
  assert.equal(shares[0], 0);
  assert.ok(shares[1] > 0.005, `${shares}`);
});

test('a case keeps its loads in the form, and problems stand at what they are about', async () => {
  const rigidWalls = [{ id: 'floor', xMm: 0, yMm: -3, normalY: 1 },
                      { id: 'ram', xMm: 160, yMm: 20, normalX: -1, massG: 5 }];
  const submitted = await daemon.presetCase('hexagon-small', (each) => {
    Object.assign(each.loading, { endTimeS: 0.0001, gravityYMPerS2: -9.5, rigidWalls });
  });
  const { name } = await daemon.call('Jobs/CreateJob', { case: submitted });
  await page.goto(`${daemon.url}/new?from=${name}`);
  assert.equal(await page.getByLabel('Gravity along y').inputValue(), '-9.5');
  await page.getByText('id ram x_mm 160 y_mm 20').waitFor();
  assert.deepEqual(await axeFindings(page), []);
  await page.getByLabel('Side').fill('8');
  await page.locator('.beside', { hasText: 'Rigid walls' }).getByText('[1]').waitFor();
  await page.getByLabel('Side').fill('4');
  await page.getByLabel('End at rest').fill('2');
  await page.locator('.field', { hasText: 'End at rest' }).getByText('Is too large.').waitFor();
  await page.getByLabel('End at rest').fill('0.25');
  await page.getByRole('button', { name: 'Start the job' }).click();
  await page.waitForURL((url) => /jobs/.test(url.pathname));
  const { case: sent } = await daemon.call('Jobs/GetJob', { name: new URL(page.url()).pathname.slice(1) });
  assert.deepEqual(sent.loading, { ...submitted.loading, endAtRest: 0.25 });
});

test('a material is picked by its name, tables are pasted, and both come back with the case', async () => {
  await page.goto(daemon.url + '/new');
  const inField = (label) => page.locator('.field', { hasText: label });
  await page.getByLabel('Named material').selectOption('AISI 4340');
  await page.getByText('torsion tests and Hopkinson bars').waitFor();
  assert.equal(await page.getByLabel('Yield stress').inputValue(), '');
  assert.equal(await page.getByLabel('Ludwik stress').getAttribute('placeholder'), '510');
  await page.getByLabel('Density').fill('7800');
  await inField('Density').getByText('AISI 4340 has 7830').waitFor();
  await page.getByLabel('Yield stress').fill('700');
  assert.ok(await page.getByLabel('Hardening beyond the table').isDisabled());
  await page.getByLabel('Hardening table').fill('0\t800\n0,05\t');
  await page.getByText('Row 2 has 1 number, not 2.').waitFor();
  await page.getByLabel('Hardening table').fill('0\t800\n0,05\t900');
  await inField('Hardening table').getByText('Stresses, row 1 is not the yield stress of 700 MPa.').waitFor();
  await page.getByLabel('Yield stress').fill('');
  await page.getByLabel('Hardening beyond the table').selectOption('POWER_LAW');
  await page.getByLabel('End strain').fill('0.01');
  await page.getByRole('button', { name: 'Start the job' }).and(page.locator(':enabled')).waitFor();
  assert.deepEqual(await axeFindings(page), []);
  await page.getByRole('button', { name: 'Start the job' }).click();
  await page.waitForURL((url) => /jobs/.test(url.pathname));
  const name = new URL(page.url()).pathname.slice(1);
  const { material } = (await daemon.call('Jobs/GetJob', { name })).case;
  assert.deepEqual([material.named, material.densityKgPerM3], ['AISI 4340', 7800]);
  assert.equal(material.ludwikStressMpa, undefined, 'the table stands in its place');
  assert.deepEqual(material.hardeningTable,
                   { plasticStrains: [0, 0.05], stressesMpa: [800, 900], beyond: 'POWER_LAW' });
  await page.goto(`${daemon.url}/new?from=${name}`);
  assert.equal(await page.getByLabel('Hardening table').inputValue(), '0\t800\n0.05\t900');
  assert.equal(await page.getByLabel('Hardening beyond the table').inputValue(), 'POWER_LAW');
  // A daemon that is older than named materials.
  await page.route('**/cellcrush.v1.Cases/ListMaterials', (route) => route.fulfill({ status: 404 }));
  await page.reload();
  assert.equal(await page.getByRole('textbox', { name: 'Named material' }).inputValue(), 'AISI 4340');
  await page.unroute('**/cellcrush.v1.Cases/ListMaterials');
});

test('a note from the form is edited by keyboard, and no other caller is overwritten unread', async () => {
  await page.goto(daemon.url + '/new');
  await page.getByText('Note, labels and priority').click();
  await page.getByLabel('Note').fill('after the repair');
  await page.getByRole('button', { name: 'Start the job' }).click();
  await page.waitForURL((url) => /jobs/.test(url.pathname));
  const name = new URL(page.url()).pathname.slice(1);
  const note = async () => (await daemon.call('Jobs/GetJob', { name })).note;
  await page.locator('.job-note', { hasText: 'after the repair' }).waitFor();
  await page.getByText('succeeded').first().waitFor();
  await page.getByRole('button', { name: 'Edit the note' }).press('Enter');
  await page.getByLabel('Note').fill('x'.repeat(2001));
  assert.deepEqual(await axeFindings(page), []);
  await page.keyboard.press('Control+Enter');
  await page.getByText('job.note has 2001 bytes. Use at most 2000.').waitFor();
  await page.getByLabel('Note').fill('buckled left');
  const update = { job: { name, note: 'from elsewhere' }, updateMask: 'note', previousNote: 'after the repair' };
  await daemon.call('Jobs/UpdateJob', update);
  await page.getByText('Meanwhile it has become “from elsewhere”. Save replaces that.').waitFor();
  assert.equal(await page.getByLabel('Note').inputValue(), 'buckled left');
  await page.getByLabel('Note').press('End');
  await page.keyboard.type(' first');
  await page.getByRole('button', { name: 'Save', exact: true }).press('Enter');
  await page.locator('.job-note', { hasText: 'buckled left first' }).waitFor();
  assert.equal(await note(), 'buckled left first');
  await page.getByRole('button', { name: 'Edit the note' }).press('Enter');
  await page.getByLabel('Note').fill('discarded');
  await page.keyboard.press('Escape');
  assert.equal(await note(), 'buckled left first');
  await page.getByRole('link', { name: 'Jobs' }).click();
  await page.locator('.jobs .job-note', { hasText: 'buckled left first' }).waitFor();
});

test('a sweep has a note, which the list shows too', async () => {
  await page.goto(daemon.url + '/sweeps/1');
  await page.getByRole('button', { name: 'Add a note' }).click();
  await page.getByLabel('Note').fill('two seeds');
  await page.keyboard.press('Control+Enter');
  await page.locator('.job-note', { hasText: 'two seeds' }).waitFor();
  await page.getByRole('link', { name: 'Jobs' }).click();
  await page.locator('.sweep-table .job-note', { hasText: 'two seeds' }).waitFor();
  await daemon.call('Sweeps/UpdateSweep',
                    { sweep: { name: 'sweeps/1', note: 'three' }, updateMask: 'note', previousNote: 'two seeds' });
  await page.locator('.sweep-table .job-note', { hasText: 'three' }).waitFor();
});

test('the page of the server shows its workers and its queue', async () => {
  const slow = await daemon.presetCase('type-i', (each) => (each.loading.speedMPerS = 1));
  const names = [];
  for (let i = 0; i < 2; ++i) names.push((await daemon.call('Jobs/CreateJob', { case: slow })).name);
  await page.goto(daemon.url + '/server');
  await page.getByText('1 of 1 job').waitFor();
  await page.getByRole('heading', { name: 'Waiting: 1' }).waitFor();
  await page.getByText('The only worker is busy').or(page.getByText('workers are busy')).first().waitFor();
  assert.deepEqual(await axeFindings(page), []);
  for (const name of names.reverse()) await daemon.call('Jobs/CancelJob', { name });
  await page.getByText('0 of 1 job').waitFor();
});

test('the chosen theme is kept', async () => {
  const background = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const automatic = await background();
  await page.getByLabel('Theme').selectOption('dark');
  assert.notEqual(await background(), automatic);
  await page.reload();
  await page.getByLabel('Theme').waitFor();
  assert.notEqual(await background(), automatic);
  await page.getByLabel('Theme').selectOption('auto');
  assert.equal(await background(), automatic);
});

test('nothing stands in the way of people who cannot see or point', async () => {
  for (const [colorScheme, width] of [['light', 1440], ['dark', 390]]) {
    await page.emulateMedia({ colorScheme });
    await page.setViewportSize({ width, height: 900 });
    for (const path of ['/', '/jobs/1', '/sweeps/1', '/compare?jobs=1,2', '/new', '/server', '/help']) {
      await page.goto(daemon.url + path);
      await page.waitForTimeout(800);
      assert.deepEqual(await axeFindings(page), [], `${path}, ${colorScheme}`);
    }
  }
});

test('no script has failed', () => assert.deepEqual(errors, []));

// Two squares with a wall that ends in the air, a wall drawn twice, and a part that nothing joins to them.
const kDrawing = `x1,y1,x2,y2
0,0,10,0\n10,0,10,10\n10,10,0,10\n0,10,0,0\n10,0,20,0\n20,0,20,10\n20,10,10,10\n20,10,14,6\n0,0,10,0\n3,3,6,3\n`;

test('a drawing that is chosen or dropped becomes the lattice, with its faults', async () => {
  await page.goto(daemon.url + '/new');
  await page.getByText('Lattice from a drawing').click();
  await page.getByLabel('Drawing', { exact: true }).setInputFiles(
    { name: 'squares.csv', mimeType: 'text/csv', buffer: Buffer.from(kDrawing) });
  await page.getByText('does not tell its unit of length').waitFor();
  await page.getByLabel('Unit of the file').selectOption('mm');
  await page.getByText('has no thickness').waitFor();
  await page.getByLabel('Thickness, where the file has none').fill('0.4');
  await page.getByLabel('Thickness, where the file has none').blur();
  await page.getByText('9 walls between 9 joints, 1 unit of the file = 1 mm').waitFor();
  await page.getByText('1 wall was drawn twice, at (5, 0) mm').waitFor();
  const marks = page.getByRole('list', { name: 'Marks' });
  await marks.getByText('3 loose ends').waitFor();
  await marks.getByText('1 part is joined to nothing else').waitFor();
  assert.equal(await page.getByLabel('Title').inputValue(), 'squares');

  const dropped = await page.evaluateHandle((text) => {
    const transfer = new DataTransfer();
    transfer.items.add(new File([text], 'cross.csv'));
    return transfer;
  }, 'x1,y1,x2,y2\n0,0,10,10\n0,10,10,0\n');
  await page.dispatchEvent('.new-case', 'drop', { dataTransfer: dropped });
  await page.getByText('1 crossing of walls, at (5, 5) mm').waitFor();
  assert.equal(await page.getByLabel('Title').inputValue(), 'cross');
  await page.getByLabel('End strain').fill('0.01');
  await page.getByRole('button', { name: 'Start the job' }).click();
  await page.waitForURL('**/jobs/*');
  const job = await daemon.call('Jobs/GetJob', { name: new URL(page.url()).pathname.slice(1) });
  assert.equal(job.case.lattice.network.walls.length, 8);
  assert.equal(job.case.title, 'cross');
});
