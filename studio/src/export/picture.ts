// One picture of what is on the page: the scene with its marks, and both charts.
import { mapFor } from '../view/colours';
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

export async function pagePicture(scene: HTMLElement, charts: HTMLCanvasElement[], words: string, dark: boolean): Promise<Blob> {
  const canvas = scene.querySelector('canvas')!;
  const overlay = scene.querySelector<SVGSVGElement>('svg.overlay');
  const ratio = canvas.width / scene.clientWidth;
  const side = Math.max(...charts.map((chart) => chart.width), 0);
  const foot = 30 * ratio;
  const title = 26 * ratio;
  const picture = document.createElement('canvas');
  picture.width = canvas.width + side;
  picture.height = Math.max(canvas.height, charts.reduce((sum, chart) => sum + chart.height + title, 0)) + foot;
  const context = picture.getContext('2d')!;
  context.fillStyle = token('panel');
  context.fillRect(0, 0, picture.width, picture.height);
  context.fillStyle = token('stage');
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.drawImage(canvas, 0, 0);
  if (overlay) context.drawImage(await imageOf(overlay), 0, 0, canvas.width, canvas.height);
  const legend = scene.querySelector<HTMLElement>('.legend [role=img]');
  const ramp = legend?.querySelector('.ramp')?.getBoundingClientRect();
  context.fillStyle = token('ink');
  context.font = `${12 * ratio}px ${token('font')}`;
  if (legend && ramp) {
    const map = mapFor(dark);
    const [left, top] = [12 * ratio, canvas.height - 34 * ratio];
    context.fillText(legend.getAttribute('aria-label') ?? '', left, top - 5 * ratio);
    for (let x = 0; x < ramp.width * ratio; ++x) {
      context.fillStyle = `rgb(${map(x / (ramp.width * ratio)).join(' ')})`;
      context.fillRect(left + x, top, 1, 8 * ratio);
    }
    context.fillStyle = token('ink');
  }
  let top = 0;
  charts.forEach((chart, i) => {
    context.fillText(['Force on the hand', 'Where the work of the hand went'][i]!, canvas.width + 12 * ratio, top + 18 * ratio);
    context.drawImage(chart, canvas.width, top + title);
    top += chart.height + title;
  });
  context.fillText(words, 12 * ratio, picture.height - 10 * ratio, picture.width - 24 * ratio);
  return new Promise((done, failed) => picture.toBlob((blob) => (blob ? done(blob) : failed(new Error('no picture'))), 'image/png'));
}
