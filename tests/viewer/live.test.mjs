// ballbot view in a browser: a finished run, and a run as it happens.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { startBrowser } from './browser.mjs';

const program = process.env.BALLBOT_PROGRAM;
const scenario = process.env.BALLBOT_SCENARIO;
// A network of this test's own, so that no other run on the machine is heard.
const channel = `LIVE_TEST_${process.pid}`;

let browser;
let folder;
before(async () => {
  browser = await startBrowser();
  folder = mkdtempSync(join(tmpdir(), 'ballbot-view-'));
});
after(async () => {
  await browser?.close();
  if (folder) rmSync(folder, { recursive: true });
});

// Starts the program; `line` is its first line on stdout, `ended` its exit code.
function start(...words) {
  const child = spawn(program, words, { stdio: ['ignore', 'pipe', 'pipe'] });
  let out = '';
  let err = '';
  child.stderr.on('data', (text) => (err += text));
  const ended = new Promise((done) => child.on('close', (code, signal) => done({ code, signal, out, err })));
  const line = new Promise((done, fail) => {
    child.stdout.on('data', (text) => {
      out += text;
      if (out.includes('\n')) done(out.split('\n')[0]);
    });
    ended.then(() => fail(new Error(`${words.join(' ')} ended: ${err}`)));
  });
  line.catch(() => undefined);
  return { child, line, ended };
}

async function openPage(url) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 } });
  const page = await context.newPage();
  page.setDefaultTimeout(120000); // machines that draw without a GPU are slow to begin
  const complaints = [];
  page.on('pageerror', (error) => complaints.push(`error: ${error.stack}`));
  page.on('console', (message) => {
    if (!message.text().includes('GPU stall due to ReadPixels')) complaints.push(message.text());
  });
  await page.goto(url, { waitUntil: 'commit' });
  return { page, complaints };
}

function scenePixels(page) {
  return page.$eval('.scene canvas', (canvas) => canvas.toDataURL());
}

test('serves the report of a finished run and ends cleanly at Ctrl-C', async () => {
  const run = join(folder, 'run');
  const made = await start('run', scenario, '--in-process', '--set', 'duration_s=0.6', '--quiet', '--out', run).ended;
  assert.ok([0, 1].includes(made.code), made.err);
  const view = start('view', run, '--json');
  const { url } = JSON.parse(await view.line);
  assert.match(url, /^http:\/\/127\.0\.0\.1:\d+\/$/);
  const { page, complaints } = await openPage(url);
  await page.waitForSelector('.transport');
  assert.deepEqual(complaints, []);
  const summary = await (await fetch(`${url}summary.json`)).json();
  assert.equal(summary.completed, true);
  assert.equal((await fetch(`${url}run.lcmlog`)).status, 404);
  assert.equal((await fetch(`${url}../../etc/passwd`)).status, 404);
  view.child.kill('SIGINT');
  const { code, err } = await view.ended;
  assert.equal(code, 0, err);
  await page.context().close();
});

test('shows a run as it happens, and the next one', async () => {
  const view = start('view', '--live', scenario, '--channel', channel);
  const url = await view.line;
  const { page, complaints } = await openPage(url);
  await page.waitForFunction(() => document.getElementById('live')?.dataset.status === 'waiting');
  const before = await scenePixels(page);
  for (const name of ['first', 'second']) {
    const run = start('run', scenario, '--live', '--channel', channel, '--set', 'duration_s=2.5',
      '--quiet', '--no-report', '--out', join(folder, name));
    await page.waitForFunction(() => document.getElementById('live').dataset.status === 'running');
    const finished = await run.ended;
    assert.ok([0, 1].includes(finished.code), finished.err);
    await page.waitForFunction(() => document.getElementById('live').dataset.status === 'ended');
    const t = await page.$eval('#live', (node) => Number(node.dataset.time));
    assert.ok(t > 2 && t <= 2.5, `${t}`);
  }
  assert.notEqual(await scenePixels(page), before);
  assert.equal(await page.locator('.live-plot .uplot').count(), 3);
  assert.deepEqual(complaints, []);
  view.child.kill('SIGINT');
  const { code, err } = await view.ended;
  assert.equal(code, 0, err);
  await page.waitForFunction(() => document.getElementById('live').dataset.status === 'gone');
  await page.context().close();
});

test('says what it cannot show', async () => {
  const { code, err } = await start('view', folder).ended;
  assert.equal(code, 2);
  assert.match(err, /no report\.html in it; give a run folder such as runs\/balance-001/);
  const taken = start('view', '--live', scenario, '--channel', channel);
  const port = new URL(await taken.line).port;
  const second = await start('view', '--live', scenario, '--channel', channel, '--port', port).ended;
  assert.equal(second.code, 2);
  assert.match(second.err, new RegExp(`port ${port} of 127.0.0.1 cannot be used`));
  taken.child.kill('SIGTERM');
  assert.equal((await taken.ended).code, 0);
});
