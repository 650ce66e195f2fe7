// Colour maps that grow evenly in lightness and can be told apart by the colour-blind: viridis (Nathaniel Smith and
// Stefan van der Walt) by the polynomial of Matt Zucker's fit, and its mirror image for light paper.
import { CanvasTexture, LinearFilter, SRGBColorSpace, type Texture } from 'three';

const fit: [number, number, number][] = [
  [0.2777273272234177, 0.005407344544966578, 0.3340998053353061],
  [0.1050930431085774, 1.404613529898575, 1.384590162594685],
  [-0.3308618287255563, 0.214847559468213, 0.09509516302823659],
  [-4.634230498983486, -5.799100973351585, -19.33244095627987],
  [6.228269936347081, 14.17993336680509, 56.69055260068105],
  [4.776384997670288, -13.74514537774601, -65.35303263337234],
  [-5.435455855934631, 4.645852612178535, 26.3124352495832],
];

export type Rgb = [number, number, number]; // 0 to 255, sRGB

export function viridis(t: number): Rgb {
  const at = Math.max(0, Math.min(1, t));
  return [0, 1, 2].map((k) => {
    let value = 0;
    for (let i = fit.length - 1; i >= 0; --i) value = value * at + fit[i]![k]!;
    return Math.round(255 * Math.max(0, Math.min(1, value)));
  }) as Rgb;
}

const steps = 128;

export function mapTexture(map: (t: number) => Rgb): Texture {
  const canvas = document.createElement('canvas');
  canvas.width = steps;
  canvas.height = 1;
  const context = canvas.getContext('2d')!;
  for (let i = 0; i < steps; ++i) {
    context.fillStyle = `rgb(${map(i / (steps - 1)).join(' ')})`;
    context.fillRect(i, 0, 1, 1);
  }
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  texture.minFilter = texture.magFilter = LinearFilter;
  texture.generateMipmaps = false;
  return texture;
}

export const mapGradient = (map: (t: number) => Rgb): string =>
  `linear-gradient(to right, ${Array.from({ length: 12 }, (_, i) => `rgb(${map(i / 11).join(' ')})`).join(', ')})`;
