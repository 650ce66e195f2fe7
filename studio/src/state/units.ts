// How numbers are written for people: SI in, a fitting unit and a fixed number of digits out, so that nothing jumps.

const minus = '\u2212';
const fixed = (value: number, digits: number): string => {
  const text = value.toFixed(digits);
  return Number(text) === 0 ? (0).toFixed(digits) : text.replace('-', minus);
};

export const newtons = (value: number, digits = 3): string => `${fixed(value, digits)} N`;
export const millimetres = (value: number, digits = 1): string => `${fixed(value * 1e3, digits)} mm`;
export const millijoules = (value: number, digits = 2): string => `${fixed(value * 1e3, digits)} mJ`;
export const kilopascals = (value: number, digits = 1): string => `${fixed(value * 1e-3, digits)} kPa`;
export const seconds = (value: number, digits = 2): string => `${fixed(value, digits)} s`;
export const plain = fixed;

// A round number that is at least `value`, and not much more.
export function niceAbove(value: number): number {
  if (!(value > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(value));
  for (const factor of [1, 1.2, 1.6, 2, 3, 4, 5, 6, 8, 10]) if (factor * power >= value * (1 - 1e-9)) return factor * power;
  return 10 * power;
}
