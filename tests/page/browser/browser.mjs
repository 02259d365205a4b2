// Chromium with a page whose errors are collected, and the checks that several tests make of a page.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { after, before } from 'node:test';
import { chromium } from 'playwright-core';
import { Daemon } from './daemon.mjs';

const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

async function launch(more) {
  return chromium.launch({ executablePath: process.env.CHROMIUM, args: ['--no-sandbox', ...more] });
}

// A page, the errors of its scripts, what its console complains of, and the addresses that it asks for.
export async function openPage(browser) {
  const page = await browser.newPage({ viewport: { width: 1440, height: 900 }, acceptDownloads: true });
  page.setDefaultTimeout(30000);
  const errors = [];
  const complaints = [];
  const requests = [];
  page.on('pageerror', (error) => errors.push(String(error)));
  page.on('console', (message) => message.type() === 'error' && complaints.push(message.text()));
  page.on('request', (request) => requests.push(request.url()));
  return { page, errors, complaints, requests };
}

// A daemon for the tests of a file, a browser, and what openPage() gives of a page in it; `prepare` gets all of these
// before the first test.
export function stage(prepare, flags = []) {
  const daemon = new Daemon();
  let browser;
  before(async () => {
    await daemon.start();
    browser = await launch(flags);
    await prepare({ browser, ...(await openPage(browser)) });
  });
  after(async () => {
    await browser?.close();
    await daemon.remove();
  });
  return daemon;
}

// What stands in the way of people who cannot see or point, as axe finds it.
export async function axeFindings(page) {
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => globalThis.axe.run());
  return violations.map((each) => `${each.id}: ${each.nodes.map((node) => node.html).join(' ')}`);
}

// How far two pictures of one size are apart, and the first one from the colour of its corner: means over the pixels
// and the colours, 0 to 1.
export async function meanDifference(browser, a, b) {
  const helper = await browser.newPage();
  const means = await helper.evaluate(async (pictures) => {
    const [one, other] = await Promise.all(pictures.map(async (data) => {
      const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${data}`)).blob());
      const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
      context.drawImage(image, 0, 0);
      return context.getImageData(4, 4, image.width - 8, image.height - 8).data;
    }));
    const mean = (of) => one.reduce((sum, value, i) => sum + Math.abs(value - of(i)), 0) / (255 * one.length);
    return { difference: mean((i) => other[i]), contrast: mean((i) => one[i % 4]) };
  }, [a, b].map((picture) => picture.toString('base64')));
  await helper.close();
  return means;
}

// The share of an element whose colour is not that of its corner, 0 to 1, in a picture of the screen; with a colour,
// "#rrggbb", the share that has it.
export async function paintedShare(page, element, colour) {
  const picture = (await element.screenshot()).toString('base64');
  const helper = await page.context().browser().newPage();
  const share = await helper.evaluate(async ([data, wanted]) => {
    const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${data}`)).blob());
    const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
    context.drawImage(image, 0, 0);
    const pixels = new Uint32Array(context.getImageData(4, 4, image.width - 8, image.height - 8).data.buffer);
    // Pixels are little-endian: the first byte is red.
    const [red, green, blue] = [1, 3, 5].map((at) => parseInt(wanted?.slice(at, at + 2), 16));
    const isCounted = wanted ? (pixel) => (pixel & 0xffffff) === (red | (green << 8) | (blue << 16))
      : (pixel) => pixel !== pixels[0];
    return pixels.filter(isCounted).length / pixels.length;
  }, [picture, colour]);
  await helper.close();
  return share;
}

// The same once the picture no longer changes.
export async function settledShare(page, element, colour) {
  let before = -1;
  for (let i = 0; i < 20; ++i) {
    await page.waitForTimeout(400);
    const share = await paintedShare(page, element, colour);
    if (share === before) return share;
    before = share;
  }
  throw new Error('the picture does not come to rest');
}
