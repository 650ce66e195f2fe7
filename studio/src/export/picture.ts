// One picture of what is on the page: the scene with its marks, and both charts.
import { token } from '../state/theme.svelte';

const kept = ['fill', 'stroke', 'stroke-width', 'stroke-dasharray', 'stroke-linejoin', 'paint-order', 'font', 'opacity', 'text-anchor'];

// An SVG of the page as an image, with the styles it has there.
async function imageOf(svg: SVGSVGElement): Promise<HTMLImageElement> {
  const copy = svg.cloneNode(true) as SVGSVGElement;
  const from = svg.querySelectorAll<SVGElement>('*');
  copy.querySelectorAll<SVGElement>('*').forEach((element, i) => {
    const style = getComputedStyle(from[i]!);
    for (const name of kept) element.style.setProperty(name, style.getPropertyValue(name));
  });
  copy.setAttribute('xmlns', 'http://www.w3.org/2000/svg');
  const image = new Image();
  image.src = `data:image/svg+xml,${encodeURIComponent(new XMLSerializer().serializeToString(copy))}`;
  await image.decode();
  return image;
}

export async function pagePicture(scene: HTMLElement, charts: HTMLCanvasElement[], words: string): Promise<Blob> {
  const canvas = scene.querySelector('canvas')!;
  const overlay = scene.querySelector<SVGSVGElement>('svg.overlay');
  const ratio = canvas.width / scene.clientWidth;
  const side = Math.max(...charts.map((chart) => chart.width), 0);
  const foot = 30 * ratio;
  const picture = document.createElement('canvas');
  picture.width = canvas.width + side;
  picture.height = Math.max(canvas.height, charts.reduce((sum, chart) => sum + chart.height, 0)) + foot;
  const context = picture.getContext('2d')!;
  context.fillStyle = token('panel');
  context.fillRect(0, 0, picture.width, picture.height);
  context.fillStyle = token('stage');
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.drawImage(canvas, 0, 0);
  if (overlay) context.drawImage(await imageOf(overlay), 0, 0, canvas.width, canvas.height);
  let top = 0;
  for (const chart of charts) {
    context.drawImage(chart, canvas.width, top);
    top += chart.height;
  }
  context.fillStyle = token('ink');
  context.font = `${12 * ratio}px ${token('font')}`;
  context.fillText(words, 12 * ratio, picture.height - 10 * ratio, picture.width - 24 * ratio);
  return new Promise((done, failed) => picture.toBlob((blob) => (blob ? done(blob) : failed(new Error('no picture'))), 'image/png'));
}
