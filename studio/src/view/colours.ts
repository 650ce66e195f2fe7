// The colour map: magma of Nathaniel Smith and Stefan van der Walt, whose lightness grows evenly and which the
// colour-blind can read, by Matt Zucker's polynomial. What is not deformed has the colour nearest to the paper behind it.
import { CanvasTexture, LinearFilter, SRGBColorSpace, type Texture } from 'three';

const fit: [number, number, number][] = [
  [-0.002136485053939582, -0.000749655052795221, -0.005386127855323933],
  [0.2516605407371642, 0.6775232436837668, 2.494026599312351],
  [8.353717279216625, -3.577719514958484, 0.3144679030132573],
  [-27.66873308576866, 14.26473078096533, -13.64921318813922],
  [52.17613981234068, -27.94360607168351, 12.94416944238394],
  [-50.76852536473588, 29.04658282127291, 4.23415299384598],
  [18.65570506591883, -11.48977351997711, -5.601961508734096],
];
const ends = { light: [0.965, 0.16], dark: [0.24, 0.99] } as const;

export type Rgb = [number, number, number]; // 0 to 255, sRGB

function magma(t: number): Rgb {
  const at = Math.max(0, Math.min(1, t));
  return [0, 1, 2].map((k) => {
    let value = 0;
    for (let i = fit.length - 1; i >= 0; --i) value = value * at + fit[i]![k]!;
    return Math.round(255 * Math.max(0, Math.min(1, value)));
  }) as Rgb;
}

export type Map = (t: number) => Rgb;
export const mapFor = (dark: boolean): Map => {
  const [from, to] = dark ? ends.dark : ends.light;
  return (t) => magma(from + (to - from) * Math.max(0, Math.min(1, t)));
};

const steps = 128;

export function mapTexture(): Texture {
  const canvas = document.createElement('canvas');
  canvas.width = steps;
  canvas.height = 1;
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  texture.minFilter = texture.magFilter = LinearFilter;
  texture.generateMipmaps = false;
  return texture;
}

export function paint(texture: Texture, map: Map): void {
  const canvas = texture.image as HTMLCanvasElement;
  const context = canvas.getContext('2d')!;
  for (let i = 0; i < steps; ++i) {
    context.fillStyle = `rgb(${map(i / (steps - 1)).join(' ')})`;
    context.fillRect(i, 0, 1, 1);
  }
  texture.needsUpdate = true;
}

export const mapGradient = (map: Map): string =>
  `linear-gradient(to right, ${Array.from({ length: 12 }, (_, i) => `rgb(${map(i / 11).join(' ')})`).join(', ')})`;
