// What a picture is told, and what it answers.
import type { Map } from './colours';
import type { Field } from './tissue';

export interface Look {
  field: Field;
  most: number; // of the field's legend, SI
  clip: boolean;
  clipShift: number; // m, of the clip plane off the needle's axis
  mesh: boolean;
  inset: boolean;
  target: number; // m, depth
}

export interface Style {
  map: Map;
  inset: string;
  skin: string;
  wall: string;
  skinOpacity: number;
  lines: string;
  linesOpacity: number;
  steel: string;
  outline: string;
  hub: string;
  force: string;
}

export type Point = { x: number; y: number };

// Places of the overlay, CSS pixels.
export interface Marks {
  entry: Point;
  target: Point;
  hub: Point;
  hubTop: Point;
  arrow: Point;
  bow: Point; // the point of the needle farthest from the line hub-entry
  chord: Point; // and that line's point beside it
  scale: number; // px a metre
}
