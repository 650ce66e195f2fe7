// What the curves draw, out of recordings: numbers rearranged, none computed anew.
import { place, type Column } from '../sources/frame';
import type { EventName } from '../sources/protocol';
import type { Recording } from '../sources/recording';
import type { Curve, Marker } from '../panel/chart';

export const eventShape: Record<EventName, Marker['shape']> = {
  contact: 'circle',
  buckling: 'diamond',
  straightening: 'triangle',
  puncture: 'down',
  second_buckling: 'square',
  layer: 'circle',
  exit: 'up',
};

// Where the work of the hand went; in the order in which the areas lie on each other.
export const ledger: { column: Column; words: string; token: string }[] = [
  { column: 'energy_needle_J', words: 'needle, bent', token: 'e-needle' },
  { column: 'energy_tissue_J', words: 'tissue, elastic', token: 'e-tissue' },
  { column: 'energy_contact_J', words: 'contact springs', token: 'e-contact' },
  { column: 'energy_kinetic_J', words: 'moving', token: 'e-kinetic' },
  { column: 'work_cutting_J', words: 'cutting', token: 'e-cutting' },
  { column: 'work_friction_J', words: 'friction', token: 'e-friction' },
  { column: 'work_damping_J', words: 'damping', token: 'e-damping' },
  { column: 'work_relaxation_J', words: 'relaxation', token: 'e-relaxation' },
  { column: 'work_numerical_J', words: 'numerical loss', token: 'e-numerical' },
  { column: 'work_snap_J', words: 'snapping straight', token: 'e-snap' },
];

const mostPoints = 900;

// Indices of at most `mostPoints` traces, first and last among them.
export function thinned(length: number, most = mostPoints): number[] {
  if (length <= most) return Array.from({ length }, (_, i) => i);
  return Array.from({ length: most }, (_, i) => Math.round((i * (length - 1)) / (most - 1)));
}

export const values = (run: Recording, indices: number[], column: Column, factor = 1): Float64Array =>
  Float64Array.from(indices, (i) => run.traces[i]![place[column]]! * factor);

export function markersOf(run: Recording, upTo: number, words: (event: EventName) => string): Marker[] {
  return run.events
    .filter((event) => event.time_s <= upTo)
    .map((event) => ({ x: event.hand_travel_m * 1e3, y: event.hand_force_N, words: words(event.event), shape: eventShape[event.event] }));
}

export function stacked(run: Recording, indices: number[], colour: (token: string) => string): Curve[] {
  const x = values(run, indices, 'time_s');
  let below = new Float64Array(indices.length);
  return ledger.map(({ column, words, token }) => {
    const above = values(run, indices, column, 1e3).map((value, i) => below[i]! + value);
    const curve: Curve = { label: words, x, y: above, colour: colour(token), width: 0, fillTo: below };
    below = above;
    return curve;
  });
}

// Paints runs apart by lightness and dash, so that a key can name them without colour.
export const earlierDash: number[][] = [[], [6, 3], [2, 3], [8, 3, 2, 3], [4, 2], [1, 2]];
