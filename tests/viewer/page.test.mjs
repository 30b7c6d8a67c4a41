// The report page in a browser: what a person would try on it.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import {
  nextFrame,
  openReport,
  picture,
  reportData,
  scrubTo,
  shownTime,
  startBrowser,
  windows,
} from './browser.mjs';

let browser;
before(async () => {
  browser = await startBrowser();
});
after(() => browser?.close());

// Runs `check` on a fresh page, which must not have complained by the end.
function onPage(name, kind, options, check) {
  test(name, async () => {
    const { page, complaints } = await openReport(browser, kind, options);
    try {
      await check(page);
      assert.deepEqual(complaints, []);
    } finally {
      await page.context().close();
    }
  });
}

const overflow = (page) => page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);

onPage('shows verdict, title, requirements and manifest of a run that passed', 'replay', {}, async (page) => {
  const data = await reportData(page);
  assert.match(await page.title(), /^Passed: Push recovery/);
  const header = await page.textContent('header');
  for (const text of ['Passed', data.title, data.subtitle, data.verdict, data.headline[0].text]) {
    assert.ok(header.includes(text), text);
  }
  assert.equal(await page.locator('.requirements tbody tr.passed').count(), data.requirements.length);
  assert.ok((await page.textContent('#manifest')).includes(data.manifest[1].text));
  assert.equal(await page.locator('#metrics table').count(), 2);
  const axes = data.groups.reduce((count, group) => count + group.axes.length, 0);
  assert.equal(await page.locator('.uplot').count(), axes);
  assert.equal(await page.locator('.path-plot svg path.curve').count() > 0, true);
});

onPage('shows what stopped a bench, opened at the first check', 'fault', {}, async (page) => {
  const data = await reportData(page);
  assert.match(await page.title(), /^Failed: Stopped: no new IMU samples/);
  const header = await page.textContent('header');
  assert.ok(header.includes('First check: imu_stale'), header);
  const row = page.locator('#first-table-1 tr.marked');
  assert.equal(await row.count(), 1);
  assert.ok((await row.textContent()).startsWith('first'));
  // One time axis for all, around the check, which is its zero.
  for (const [start, end] of await windows(page)) assert.deepEqual([start, end], [data.view.start, data.view.end]);
  assert.equal(await shownTime(page), 0);
  assert.ok((await page.locator('.lane-plot .lane-bar.bad').count()) > 0);
  const words = await page.locator('.lane-plot').textContent();
  for (const text of ['wheel 1', 'operation enabled', 'no new sample', 'first: imu_stale']) assert.ok(words.includes(text), text);
  assert.ok((await page.textContent('#table-1')).includes('6041:00 statusword'));
});

onPage('opens the page of troubleshooting from the header of a record', 'fault', {}, async (page) => {
  const text = page.locator('#document-bench-imu-md pre');
  assert.ok(!(await text.isVisible()));
  await page.click('header a');
  assert.ok(await text.isVisible());
  assert.ok((await text.textContent()).startsWith('# '));
});

onPage('zooms and scrubs in the lanes of states as in the plots', 'fault', {}, async (page) => {
  const box = await page.locator('.lane-plot svg').boundingBox();
  const y = box.y + 40;
  await page.mouse.click(box.x + 200, y);
  await nextFrame(page);
  const t = await shownTime(page);
  assert.ok(t < 0, `went to ${t}`);
  await page.mouse.move(box.x + 200, y);
  await page.mouse.down();
  await page.mouse.move(box.x + 400, y);
  await page.mouse.up();
  await nextFrame(page);
  const [start, end] = (await windows(page))[0];
  assert.ok(Math.abs(start - t) < 0.01 && end > start, `${start} to ${end}`);
  await page.mouse.dblclick(box.x + 300, y);
  await nextFrame(page);
  const data = await reportData(page);
  assert.deepEqual((await windows(page))[0], [data.start, data.end]);
});

onPage('says at once that a run failed, and why', 'failed', {}, async (page) => {
  assert.match(await page.title(), /^Failed: /);
  const mark = page.locator('header .verdict-mark');
  assert.equal((await mark.textContent()).trim(), 'Failed');
  assert.ok(await mark.evaluate((node) => node.getBoundingClientRect().bottom < 100));
  assert.ok((await page.textContent('header')).includes('1 of 3 requirements missed'));
  const failed = page.locator('.requirements tr.failed');
  assert.equal(await failed.count(), 1);
  assert.ok((await failed.textContent()).includes('Final ball position error'));
});

onPage('draws the robot where it is, not an empty canvas', 'replay', {}, async (page) => {
  for (const layer of ['Forces', 'Frames', 'Traces']) await page.click(`.toggle:text("${layer}")`);
  await scrubTo(page, 2);
  const upright = await picture(page);
  assert.ok(upright.colours > 500, `${upright.colours} colours`);
  // The battery and the joints are the only red things left.
  assert.ok(upright.red > 60, `${upright.red} red pixels`);
  await page.click('.toggle:text("Follow")');
  await scrubTo(page, 5.8);
  const leaning = await picture(page);
  assert.ok(leaning.red > 60, `${leaning.red} red pixels`);
  assert.ok(leaning.redLeft - upright.redLeft > 5, 'it rolled along x, to the right of the picture');
});

onPage('plays, and stops when told', 'replay', {}, async (page) => {
  await nextFrame(page);
  const still = await picture(page);
  await page.selectOption('.speed', '0.1'); // however busy the machine, the end is far
  await page.click('.play');
  await page.waitForFunction(() => Number(document.querySelector('.transport').dataset.time) > 0.05);
  await page.click('.play');
  await page.waitForSelector('.transport[data-playing="false"]');
  const stopped = await shownTime(page);
  assert.ok(stopped < 10);
  await nextFrame(page);
  assert.notEqual((await picture(page)).sum, still.sum);
  await page.waitForTimeout(150);
  assert.equal(await shownTime(page), stopped);
});

onPage('plays at the chosen speed and stops at the end', 'replay', {}, async (page) => {
  await scrubTo(page, 9.5);
  await page.selectOption('.speed', '4');
  const seconds = await page.evaluate(async () => {
    const start = performance.now();
    const passed = () => (performance.now() - start) / 1000;
    document.querySelector('.play').click();
    const { dataset } = document.querySelector('.transport');
    while (dataset.playing === 'true' && passed() < 20) await new Promise((done) => setTimeout(done, 5));
    return passed();
  });
  assert.equal(await shownTime(page), 10);
  assert.ok(seconds > 0.1 && seconds < 20, `0.5 s at 4 times took ${seconds} s`);
});

onPage('scrubbing moves marker, values and robot', 'replay', {}, async (page) => {
  const data = await reportData(page);
  await scrubTo(page, 1);
  const before = await picture(page);
  for (const t of [2.25, 5.75]) {
    await scrubTo(page, t);
    assert.ok(Math.abs((await shownTime(page)) - t) < 1e-9);
    const markers = await page.$$eval('.time-marker', (nodes) => nodes.map((n) => parseFloat(n.style.left)));
    assert.ok(markers.length > 3);
    for (const left of markers) assert.ok(Math.abs(left - (100 * t) / data.end) < 1e-6);
    assert.notEqual((await picture(page)).sum, before.sum);
  }
  // The value beside the line is the sample of the run at that time.
  await scrubTo(page, 2.25);
  const line = data.groups[0].axes[0].series[2];
  assert.equal(line.name, 'y measured');
  const samples = Buffer.from(line.values, 'base64');
  const expected = samples.readFloatLE(4 * Math.round(2.25 / 0.0025));
  const shown = await page.locator('.legend-line', { hasText: 'y measured' }).locator('.legend-value').textContent();
  assert.ok(Math.abs(Number(shown.replace('−', '-')) - expected) <= 5e-4, `${shown} for ${expected}`);
});

onPage('labels a force while it acts', 'replay', {}, async (page) => {
  const push = page.locator('.force-label').nth(0);
  const contact = page.locator('.force-label').nth(1);
  for (const [t, pushed, touched] of [[1, false, false], [2.25, true, false], [5.75, false, true]]) {
    await scrubTo(page, t);
    assert.equal(await push.isVisible(), pushed, `push at ${t} s`);
    assert.equal(await contact.isVisible(), touched, `contact at ${t} s`);
  }
  await scrubTo(page, 2.25);
  assert.equal(await push.textContent(), 'push 20.0 N');
  await page.click('text=Forces');
  assert.equal(await push.isVisible(), false);
});

onPage('zooming one plot zooms all, and a double click shows all again', 'replay', {}, async (page) => {
  const plot = page.locator('.u-over').first();
  const box = await plot.boundingBox();
  const y = box.y + box.height / 2;
  await page.mouse.move(box.x + 0.2 * box.width, y);
  await page.mouse.down();
  await page.mouse.move(box.x + 0.4 * box.width, y, { steps: 4 });
  await page.mouse.up();
  await nextFrame(page);
  const zoomed = await windows(page);
  assert.ok(zoomed.length > 3);
  for (const [start, end] of zoomed) {
    assert.ok(Math.abs(start - 2) < 0.05 && Math.abs(end - 4) < 0.05, `${start} to ${end}`);
    assert.deepEqual([start, end], zoomed[0]);
  }
  assert.equal(await shownTime(page), 0, 'a drag is no click');
  const selections = await page.$$eval('.u-select', (nodes) => nodes.map((n) => n.clientWidth));
  assert.ok(selections.every((width) => width === 0), 'the selection is gone');
  await page.mouse.dblclick(box.x + 0.5 * box.width, y);
  await nextFrame(page);
  for (const shown of await windows(page)) assert.deepEqual(shown, [0, 10]);
});

onPage('zooms by buttons and keys, about the time shown', 'replay', {}, async (page) => {
  await scrubTo(page, 4);
  await page.click('[aria-label="Zoom in"]');
  assert.deepEqual((await windows(page))[0], [2, 7]);
  await page.click('.reset-zoom');
  assert.deepEqual((await windows(page))[0], [0, 10]);
  await page.locator('h1').click();
  await page.keyboard.press('+');
  assert.deepEqual((await windows(page))[0], [2, 7]);
  await page.keyboard.press('0');
  assert.deepEqual((await windows(page))[0], [0, 10]);
  await page.keyboard.press('ArrowRight');
  assert.ok(Math.abs((await shownTime(page)) - 4.02) < 1e-9);
});

onPage('a click on a plot is the time shown there', 'replay', {}, async (page) => {
  const box = await page.locator('.u-over').nth(1).boundingBox();
  await page.mouse.click(box.x + 0.3 * box.width, box.y + 20);
  await nextFrame(page);
  assert.ok(Math.abs((await shownTime(page)) - 3) < 0.03);
});

onPage('the cursor of one plot is the cursor of all', 'replay', {}, async (page) => {
  const box = await page.locator('.u-over').first().boundingBox();
  const value = page.locator('.legend-line', { hasText: 'roll' }).locator('.legend-value');
  const before = await value.textContent();
  await page.mouse.move(box.x + 0.28 * box.width, box.y + 30);
  await nextFrame(page);
  const at = await page.$$eval('.u-over', (nodes) =>
    nodes.map((n) => n.querySelector('.u-cursor-x').getBoundingClientRect().left - n.getBoundingClientRect().left),
  );
  assert.ok(at.length > 3);
  for (const left of at) assert.ok(Math.abs(left - 0.28 * box.width) < 2, `${left}`);
  assert.notEqual(await value.textContent(), before);
  await page.mouse.move(5, 5);
  await nextFrame(page);
  assert.equal(await value.textContent(), before);
});

onPage('a line can be hidden', 'replay', {}, async (page) => {
  const canvas = page.locator('.uplot canvas').first();
  const before = await canvas.evaluate((node) => node.toDataURL());
  const button = page.locator('button.legend-line').first();
  await button.click();
  await nextFrame(page);
  assert.equal(await button.getAttribute('aria-pressed'), 'false');
  assert.notEqual(await canvas.evaluate((node) => node.toDataURL()), before);
});

for (const kind of ['replay', 'no-replay', 'failed', 'fault']) {
  onPage(`fits windows from 400 to 1920 px, also while they change (${kind})`, kind, {}, async (page) => {
    for (const width of [400, 1920, 860, 1280, 400]) {
      await page.setViewportSize({ width, height: 800 });
      await nextFrame(page);
      await nextFrame(page);
      assert.ok((await overflow(page)) <= 0, `${width}`);
      const wide = await page.$$eval(
        // A table of words is as wide as its words and scrolls in a frame of its own.
        'canvas, svg, table:not(.words), .words-frame, button, select, p',
        (nodes, limit) => nodes.filter((n) => n.getBoundingClientRect().right > limit + 0.5).map((n) => n.outerHTML),
        width,
      );
      assert.deepEqual(wide, []);
      const [plot, body] = await page.$eval('.uplot', (n) => [n.clientWidth, n.parentElement.clientWidth]);
      assert.equal(plot, body);
      if (kind === 'no-replay' || kind === 'fault') continue;
      const stretch = await page.$eval('.scene canvas', (n) => n.width / n.height / (n.clientWidth / n.clientHeight));
      assert.ok(Math.abs(stretch - 1) < 0.01);
    }
  });
}

onPage('waits with drawing until its window has a size', 'replay', { width: 40 }, async (page) => {
  await page.setViewportSize({ width: 1280, height: 800 });
  await nextFrame(page);
  await nextFrame(page);
  const [plot, body] = await page.$eval('.uplot', (n) => [n.clientWidth, n.parentElement.clientWidth]);
  assert.ok(plot > 600);
  assert.equal(plot, body);
});

// Contrast ratio of two opaque colours after WCAG 2.
function contrast(a, b) {
  const luminance = (hex) => {
    const channels = [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255);
    const [r, g, blue] = channels.map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * blue;
  };
  const [light, dark] = [luminance(a), luminance(b)].sort((x, y) => y - x);
  return (light + 0.05) / (dark + 0.05);
}

for (const colorScheme of ['light', 'dark']) {
  onPage(`has readable colours in the ${colorScheme} scheme`, 'replay', { colorScheme }, async (page) => {
    const colour = await page.evaluate(() => {
      const style = getComputedStyle(document.documentElement);
      const names = [...document.styleSheets[0].cssRules]
        .filter((rule) => rule.selectorText === ':root')
        .flatMap((rule) => [...rule.style].filter((name) => name.startsWith('--')));
      return Object.fromEntries(names.map((name) => [name.slice(2), style.getPropertyValue(name).trim()]));
    });
    assert.equal(colour.scheme, colorScheme);
    for (const name of Object.keys(colour)) {
      if (/^#...$/.test(colour[name])) colour[name] = colour[name].replace(/[^#]/g, '$&$&');
    }
    const readable = [['text', 'card'], ['text', 'page'], ['muted', 'card'], ['accent', 'card'],
      ['on-accent', 'accent'], ['passed', 'passed-ground'], ['failed', 'failed-ground'], ['failed', 'card'],
      ['push-ink', 'card'], ['contact-ink', 'card'], ['hold-ink', 'card'], ['fault-ink', 'card']];
    for (const [a, b] of readable) assert.ok(contrast(colour[a], colour[b]) >= 4.5, `${a} on ${b}`);
    const lines = Object.keys(colour).filter((name) => name.startsWith('series-'));
    assert.equal(lines.length, 12);
    for (const line of lines) assert.ok(contrast(colour[line], colour.card) >= 3, line);
  });
}

onPage('changes its plots with the colour scheme', 'replay', {}, async (page) => {
  const canvas = page.locator('.uplot canvas').first();
  const light = await canvas.evaluate((node) => node.toDataURL());
  await page.emulateMedia({ colorScheme: 'dark' });
  await nextFrame(page);
  assert.notEqual(await page.locator('.uplot canvas').first().evaluate((node) => node.toDataURL()), light);
});

onPage('prints on white, with sharper plots, and is itself again afterwards', 'replay', { colorScheme: 'dark' }, async (page) => {
  await nextFrame(page);
  await page.evaluate(() => {
    window.addEventListener('afterprint', () => (window.printed = true));
    window.addEventListener('beforeprint', () => queueMicrotask(() => queueMicrotask(() => {
      const canvas = document.querySelector('.uplot canvas');
      window.onPaper = {
        scheme: getComputedStyle(document.documentElement).getPropertyValue('--scheme').trim(),
        sharpness: canvas.width / canvas.getBoundingClientRect().width,
      };
    })));
  });
  const screenWidth = await page.$eval('.uplot', (node) => node.clientWidth);
  const pdf = await page.pdf({ preferCSSPageSize: true, printBackground: true });
  await page.waitForFunction(() => window.printed);
  await nextFrame(page);
  const onPaper = await page.evaluate(() => window.onPaper);
  assert.equal(onPaper.scheme, 'light');
  assert.ok(onPaper.sharpness > 2.5, `${onPaper.sharpness}`);
  const pages = pdf.toString('latin1').match(/\/Type\s*\/Page\b/g).length;
  assert.ok(pages >= 2 && pages <= 4, `${pages} pages`);
  assert.equal(await page.$eval('.uplot', (node) => node.clientWidth), screenWidth);
  assert.equal(await page.evaluate(() => document.documentElement.className), '');
});

onPage('shows the plots of a run without a replay', 'no-replay', {}, async (page) => {
  assert.equal(await page.locator('.scene').count(), 0);
  await scrubTo(page, 3);
  const left = await page.$eval('.time-marker', (node) => parseFloat(node.style.left));
  assert.ok(Math.abs(left - 30) < 1e-6);
});

test('says so where a browser has no WebGL, and still shows the plots', async () => {
  const { page, complaints } = await openReport(browser, 'replay', {
    init: () => {
      const getContext = HTMLCanvasElement.prototype.getContext;
      HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
        return kind.startsWith('webgl') ? null : getContext.call(this, kind, ...rest);
      };
    },
  });
  assert.match(await page.textContent('.notice'), /cannot draw the 3-D replay, which needs WebGL 2/);
  await scrubTo(page, 3);
  assert.ok((await page.locator('.time-marker').count()) > 3);
  assert.deepEqual(complaints.filter((text) => !text.includes('WebGL')), []);
  await page.context().close();
});
