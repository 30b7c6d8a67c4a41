// A headless Chromium of its own for the tests of the page, and what they ask of it again and again.
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

const require = createRequire(new URL('../../viewer/package.json', import.meta.url));
const { chromium } = require('playwright-core');

const pages = process.env.BALLBOT_PAGES;
const executablePath = process.env.BALLBOT_CHROMIUM;

// Playwright gives every browser a fresh profile and removes it afterwards.
export async function startBrowser() {
  if (!executablePath || executablePath.endsWith('-NOTFOUND')) {
    throw new Error('No Chromium was found when the build was configured. Try: ./bootstrap packages');
  }
  return chromium.launch({
    executablePath,
    args: [
      '--no-sandbox',
      '--disable-gpu',
      '--disable-quic',
      '--no-first-run',
      '--disable-background-networking',
      '--disable-component-update',
      '--disable-sync',
    ],
  });
}

// Opens the example page of that kind; `init` runs before its own program. `complaints` lists what a page should never have: errors,
// warnings of the page itself, requests beyond the one file.
export async function openReport(browser, kind, options = {}) {
  const { width = 1280, height = 800, colorScheme = 'light', init } = options;
  const context = await browser.newContext({ viewport: { width, height }, colorScheme });
  const page = await context.newPage();
  if (init) await page.addInitScript(init);
  const url = pathToFileURL(join(pages, `${kind}.html`)).href;
  const complaints = [];
  page.on('pageerror', (error) => complaints.push(`error: ${error.stack}`));
  page.on('console', (message) => {
    // The software renderer remarks that reading its pixels, as these tests do, is slow.
    if (!message.text().includes('GPU stall due to ReadPixels')) {
      complaints.push(`${message.type()}: ${message.text()}`);
    }
  });
  page.on('request', (request) => {
    if (request.url() !== url && !request.url().startsWith('data:')) complaints.push(`request: ${request.url()}`);
  });
  await page.goto(url);
  await page.waitForSelector('.transport');
  return { page, complaints };
}

// Moves the time slider as a hand would.
export async function scrubTo(page, t) {
  await page.evaluate((time) => {
    const slider = document.querySelector('.scrubber');
    const end = Number(document.querySelector('.time-now').textContent.split('/')[1].replace('s', ''));
    slider.value = String(Math.round((time / end) * Number(slider.max)));
    slider.dispatchEvent(new Event('input', { bubbles: true }));
  }, t);
  await nextFrame(page);
}

// Waits until what was asked for has been drawn.
export async function nextFrame(page) {
  await page.evaluate(
    () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done)))),
  );
}

export function shownTime(page) {
  return page.$eval('.transport', (node) => Number(node.dataset.time));
}

// [start, end] of every plot over time.
export function windows(page) {
  return page.$$eval('.plot[data-window]', (nodes) => nodes.map((n) => n.dataset.window.split(',').map(Number)));
}

// The 3-D picture, reduced to 160 x 160: how many different colours, a sum that any change of it
// changes, how many red pixels and their mean distance from the left.
export function picture(page) {
  return page.evaluate(async () => {
    const source = document.querySelector('.scene canvas');
    const copy = document.createElement('canvas');
    copy.width = 160;
    copy.height = 160;
    const context = copy.getContext('2d');
    context.drawImage(source, 0, 0, copy.width, copy.height);
    const { data } = context.getImageData(0, 0, copy.width, copy.height);
    const colours = new Set();
    let sum = 0;
    let red = 0;
    let left = 0;
    for (let i = 0; i < data.length; i += 4) {
      const colour = (data[i] << 16) | (data[i + 1] << 8) | data[i + 2];
      colours.add(colour);
      sum = (sum * 31 + colour) % 2147483647;
      if (data[i] > 60 && data[i] > 2.2 * data[i + 1] && data[i] > 2.2 * data[i + 2]) {
        red++;
        left += (i / 4) % copy.width;
      }
    }
    return { colours: colours.size, sum, red, redLeft: left / red };
  });
}

// Data of the page, as the program in it reads them.
export function reportData(page) {
  return page.$eval('#report-data', (node) => JSON.parse(node.textContent));
}
