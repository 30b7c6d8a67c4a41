const superscripts = '⁰¹²³⁴⁵⁶⁷⁸⁹';

function exponentText(exponent: number): string {
  const digits = String(Math.abs(exponent)).replace(/\d/g, (d) => superscripts[Number(d)]);
  return (exponent < 0 ? '⁻' : '') + digits;
}

function withoutTrailingZeros(text: string): string {
  return text.includes('.') ? text.replace(/\.?0+$/, '') : text;
}

function scientificText(value: number, digits: number): string {
  const [mantissa, exponent] = value.toExponential(digits - 1).split('e');
  return `${withoutTrailingZeros(mantissa)}·10${exponentText(Number(exponent))}`;
}

// Plain numbers would be all zeros below and too long above.
function needsPowerOfTen(size: number): boolean {
  return size !== 0 && (size < 1e-3 || size >= 1e6);
}

// For tables: `digits` significant digits without zeros at the end, a true minus sign, powers of
// ten where a plain number would be long. What is not finite is a dash.
export function numberText(value: number | null, digits = 4): string {
  if (value === null || !Number.isFinite(value)) return '–';
  if (needsPowerOfTen(Math.abs(value))) return scientificText(value, digits).replace('-', '−');
  const plain = Number(value.toPrecision(digits)).toString();
  return plain.replace('-', '−');
}

// For values that change while one looks: always as many decimals as the size of the numbers
// around it needs, so that the digits stand still.
export function steadyNumberText(value: number, largest: number): string {
  if (!Number.isFinite(value)) return '–';
  if (needsPowerOfTen(largest)) return scientificText(value, 3).replace('-', '−');
  const whole = largest < 1 ? 0 : Math.floor(Math.log10(largest)) + 1;
  const text = value.toFixed(Math.max(0, 4 - Math.max(whole, 1)));
  return text.replace(/^-(0(?:\.0*)?)$/, '$1').replace('-', '−');
}

// Seconds with as many decimals as a window of that length needs.
export function timeText(t: number, windowLength = 10): string {
  const decimals = windowLength < 0.5 ? 4 : windowLength < 5 ? 3 : 2;
  return t.toFixed(decimals).replace('-', '−');
}
