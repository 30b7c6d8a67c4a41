import assert from 'node:assert/strict';
import test from 'node:test';
import { numberText, steadyNumberText, timeText } from '../../../viewer/src/number_text';

test('table numbers have four significant digits and no empty ones', () => {
  const cases: [number | null, string][] = [
    [0, '0'],
    [8.52941, '8.529'],
    [0.29271, '0.2927'],
    [0.01, '0.01'],
    [-20, '−20'],
    [123456, '123500'],
    [3.7972e-4, '3.797·10⁻⁴'],
    [-2e7, '−2·10⁷'],
    [NaN, '–'],
    [null, '–'],
  ];
  for (const [value, text] of cases) assert.equal(numberText(value), text);
});

test('a number read back is within its digits of the number written', () => {
  for (let i = 0; i < 400; i++) {
    const value = Math.sin(i) * 10 ** ((i % 9) - 3);
    const text = numberText(value).replace(/·10.*$/, '').replace('−', '-');
    const scale = /·10/.test(numberText(value)) ? 10 ** Math.floor(Math.log10(Math.abs(value))) : 1;
    assert.ok(Math.abs(Number(text) * scale - value) <= 5e-4 * Math.abs(value) + 1e-12, `${value}`);
  }
});

test('changing numbers keep their decimals', () => {
  assert.equal(steadyNumberText(0.5, 0.9), '0.500');
  assert.equal(steadyNumberText(-0.00001, 0.9), '0.000');
  assert.equal(steadyNumberText(3, 12.5), '3.00');
  assert.equal(steadyNumberText(-8, 2345), '−8');
  assert.equal(steadyNumberText(2.5e-5, 9e-5), '2.5·10⁻⁵');
  assert.equal(steadyNumberText(NaN, 1), '–');
});

test('times get finer as the window gets shorter', () => {
  assert.equal(timeText(1.23456), '1.23');
  assert.equal(timeText(1.23456, 2), '1.235');
  assert.equal(timeText(1.23456, 0.1), '1.2346');
});
