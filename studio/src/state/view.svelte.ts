// How the person looks at it: nothing here changes what happens.
import { niceAbove } from './units';
import type { Field } from '../view/tissue';
import type { ViewName } from '../view/rig';

// Smallest legends, so that the first touch does not glow.
const leastScale: Record<Field, number> = { displacement: 5e-3, stress: 10e3 };

class ViewState {
  field = $state<Field>('displacement');
  clip = $state(true);
  clipShift = $state(0); // m
  mesh = $state(true);
  inset = $state(true);
  target = $state(30e-3); // m, depth
  name = $state<ViewName>('overview');
  asked = $state(0); // counts the presses of a preset view
  scale = $state<Record<Field, number>>({ ...leastScale });

  look(name: ViewName): void {
    this.name = name;
    this.asked += 1;
  }

  // The legend only grows within an insertion, and by steps, so that it does not flicker.
  grow(largest: number): void {
    if (largest > this.scale[this.field]) this.scale[this.field] = niceAbove(largest);
  }

  restart(): void {
    this.scale = { ...leastScale };
  }
}

export const view = new ViewState();
