// Chart: uPlot with curves over any x, also one that goes back (a needle that is withdrawn), in the page's tokens.
import uPlot from 'uplot';
import { token } from '../state/theme.svelte';

export interface Curve {
  label: string;
  x: ArrayLike<number>;
  y: ArrayLike<number>;
  colour: string; // of CSS
  width: number;
  dash?: number[];
  fillTo?: ArrayLike<number>; // fills down to these values at the same x
}

export interface Level {
  at: number;
  words: string;
  colour: string;
}

export interface Marker {
  x: number;
  y: number;
  words: string;
  shape: 'circle' | 'down' | 'square' | 'up' | 'diamond' | 'triangle';
}

export interface Drawing {
  curves: Curve[];
  levels: Level[];
  markers: Marker[];
  x: { label: string; least: number; most: number };
  y: { label: string; least: number; most: number };
}

const nothing: Curve = { label: '', x: [], y: [], colour: 'transparent', width: 0 };
const font = () => `11px ${token('font')}`;

export class Chart {
  private plot: uPlot | null = null;
  private drawing: Drawing | null = null;
  private made = '';

  constructor(
    private readonly box: HTMLElement,
    private width: number,
    private height: number,
  ) {}

  draw(wanted: Drawing, theme: string): void {
    const drawing = wanted.curves.length > 0 ? wanted : { ...wanted, curves: [nothing] };
    this.drawing = drawing;
    const key = `${theme} ${drawing.curves.length} ${drawing.x.label} ${drawing.y.label}`;
    if (key !== this.made) {
      this.made = key;
      this.build(drawing);
    } else {
      this.plot!.batch(() => {
        this.plot!.setData(dataOf(drawing), false);
        this.scale(drawing);
      });
    }
  }

  resize(width: number, height: number): void {
    if (width === this.width && height === this.height) return;
    this.width = width;
    this.height = height;
    this.plot?.setSize({ width, height });
  }

  get canvas(): HTMLCanvasElement | null {
    return this.box.querySelector('canvas');
  }

  // Values under a place in the box [CSS px], and back.
  valueAt(x: number, y: number): { x: number; y: number } | null {
    const plot = this.plot;
    if (!plot) return null;
    const inner = plot.over.getBoundingClientRect();
    const outer = this.box.getBoundingClientRect();
    const [px, py] = [x - (inner.left - outer.left), y - (inner.top - outer.top)];
    if (px < 0 || py < 0 || px > inner.width || py > inner.height) return null;
    return { x: plot.posToVal(px, 'x'), y: plot.posToVal(py, 'y') };
  }
  placeOf(x: number, y: number): { x: number; y: number } {
    const plot = this.plot!;
    return { x: plot.valToPos(x, 'x') + plot.over.offsetLeft, y: plot.valToPos(y, 'y') + plot.over.offsetTop };
  }

  dispose(): void {
    this.plot?.destroy();
    this.plot = null;
  }

  private scale({ x, y }: Drawing): void {
    this.plot!.setScale('x', { min: x.least, max: x.most });
    this.plot!.setScale('y', { min: y.least, max: y.most });
  }

  private build(drawing: Drawing): void {
    this.plot?.destroy();
    const ink = token('quiet');
    const line = token('line');
    const axis = (label: string, size: number): uPlot.Axis => ({
      label,
      labelSize: 16,
      labelGap: 0,
      labelFont: font(),
      font: font(),
      stroke: ink,
      size,
      gap: 3,
      grid: { stroke: line, width: 1 },
      ticks: { stroke: line, width: 1, size: 4 },
    });
    this.plot = new uPlot(
      {
        mode: 2,
        width: this.width,
        height: this.height,
        pxAlign: 0,
        padding: [8, 10, 0, 0],
        legend: { show: false },
        cursor: { show: false },
        scales: { x: { time: false, auto: false, range: (_, a, b) => [a, b] }, y: { auto: false, range: (_, a, b) => [a, b] } },
        axes: [
          { ...axis(drawing.x.label, 24), space: 50 },
          { ...axis(drawing.y.label, 36), space: 28 },
        ],
        series: [{}, ...drawing.curves.map((_, i): uPlot.Series => this.series(i))],
        hooks: { drawAxes: [(plot) => this.drawLevels(plot)], draw: [(plot) => this.drawMarkers(plot)] },
      },
      dataOf(drawing),
      this.box,
    );
    this.scale(drawing);
  }

  private series(index: number): uPlot.Series {
    return {
      facets: [
        { scale: 'x', auto: false },
        { scale: 'y', auto: false },
      ],
      paths: (plot) => {
        const curve = this.drawing!.curves[index];
        if (curve) drawCurve(plot, curve);
        return null;
      },
      points: { show: false },
    } as uPlot.Series;
  }

  // Below the curves, which must be seen whole.
  private drawLevels(plot: uPlot): void {
    const { levels } = this.drawing!;
    const { ctx } = plot;
    const { left, top, width, height } = plot.bbox;
    const ratio = devicePixelRatio;
    ctx.save();
    ctx.beginPath();
    ctx.rect(left, top, width, height);
    ctx.clip();
    ctx.font = `${11 * ratio}px ${token('font')}`;
    for (const level of levels) {
      const y = plot.valToPos(level.at, 'y', true);
      ctx.strokeStyle = ctx.fillStyle = level.colour;
      ctx.lineWidth = 1.5 * ratio;
      ctx.setLineDash([2 * ratio, 3 * ratio]);
      ctx.beginPath();
      ctx.moveTo(left, y);
      ctx.lineTo(left + width, y);
      ctx.stroke();
      ctx.setLineDash([]);
      ctx.textAlign = 'right';
      ctx.textBaseline = 'bottom';
      ctx.save();
      ctx.strokeStyle = token('panel');
      ctx.lineWidth = 3 * ratio;
      ctx.strokeText(level.words, left + width - 4 * ratio, y - 2 * ratio);
      ctx.restore();
      ctx.fillText(level.words, left + width - 4 * ratio, y - 2 * ratio);
    }
    ctx.restore();
  }

  private drawMarkers(plot: uPlot): void {
    const { markers } = this.drawing!;
    const { ctx } = plot;
    const ratio = devicePixelRatio;
    ctx.save();
    for (const marker of markers) {
      const x = plot.valToPos(marker.x, 'x', true);
      const y = plot.valToPos(marker.y, 'y', true);
      ctx.fillStyle = token('panel');
      ctx.strokeStyle = token('ink');
      ctx.lineWidth = 1.75 * ratio;
      shapePath(ctx, marker.shape, x, y, 4.5 * ratio);
      ctx.fill();
      ctx.stroke();
    }
    ctx.restore();
  }
}

function dataOf({ curves }: Drawing): uPlot.AlignedData {
  return [null, ...curves.map(({ x, y }) => [x, y])] as unknown as uPlot.AlignedData;
}

function drawCurve(plot: uPlot, { x, y, colour, width, dash = [], fillTo }: Curve): void {
  const { ctx } = plot;
  const ratio = devicePixelRatio;
  const { left, top, width: w, height: h } = plot.bbox;
  ctx.save();
  ctx.beginPath();
  ctx.rect(left, top, w, h);
  ctx.clip();
  ctx.beginPath();
  const at = (i: number, v: ArrayLike<number>): [number, number] => [plot.valToPos(x[i]!, 'x', true), plot.valToPos(v[i]!, 'y', true)];
  for (let i = 0; i < x.length; ++i) ctx.lineTo(...at(i, y));
  if (fillTo) {
    for (let i = x.length - 1; i >= 0; --i) ctx.lineTo(...at(i, fillTo));
    ctx.closePath();
    ctx.fillStyle = colour;
    ctx.fill();
  } else {
    ctx.strokeStyle = colour;
    ctx.lineWidth = width * ratio;
    ctx.lineJoin = 'round';
    ctx.setLineDash(dash.map((d) => d * ratio));
    ctx.stroke();
  }
  ctx.restore();
}

function shapePath(ctx: CanvasRenderingContext2D, shape: Marker['shape'], x: number, y: number, r: number): void {
  ctx.beginPath();
  const corners: Record<string, [number, number][]> = {
    down: [[-1, -0.8], [1, -0.8], [0, 1]],
    up: [[-1, 0.8], [1, 0.8], [0, -1]],
    triangle: [[-1, -1], [1, 0], [-1, 1]],
    square: [[-0.85, -0.85], [0.85, -0.85], [0.85, 0.85], [-0.85, 0.85]],
    diamond: [[0, -1.2], [1.1, 0], [0, 1.2], [-1.1, 0]],
  };
  const found = corners[shape];
  if (!found) ctx.arc(x, y, r * 0.9, 0, 2 * Math.PI);
  else {
    for (const [dx, dy] of found) ctx.lineTo(x + dx * r, y + dy * r);
    ctx.closePath();
  }
}
