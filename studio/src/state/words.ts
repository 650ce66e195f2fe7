// Stages and events in words.
import type { EventName, Model, Stage } from '../sources/protocol';
import type { Trace } from '../sources/frame';
import { place } from '../sources/frame';
import { millimetres, newtons } from './units';

export const stageWord: Record<Stage, string> = {
  free: 'Free',
  contact: 'In contact',
  buckled: 'Buckled',
  inserted: 'Inserted',
  inserted_buckled: 'Inserted, buckled',
  withdrawn: 'Withdrawn',
};

export const eventWord: Record<EventName, string> = {
  contact: 'Contact',
  buckling: 'Buckling',
  straightening: 'Straight again',
  puncture: 'Puncture',
  second_buckling: 'Second buckling',
  layer: 'Layer',
  exit: 'Tip out',
};

// A run in a few words, to tell it from others.
export function labelOf(model: Model): string {
  const needle = model.scene.needle ?? {};
  const opens = model.scene.tissue?.rigid === true ? 'on a wall' : `opens at ${newtons(model.rupture_force_N, 2)}`;
  const support = String(needle.support ?? '').replaceAll('_', '-');
  return `${needle.length_mm} mm, r ${needle.radius_mm} mm, ${opens}, ${support}`;
}

export interface Story {
  title: string;
  text: string;
  offer?: { words: string; settings: Record<string, number | string> };
}

// What one sees, and why, in two sentences: from the stage, the model's own numbers and the events so far.
export function story(stage: Stage, trace: Trace, model: Model, happened: Set<EventName>, moved: boolean, device: string | null): Story {
  const critical = newtons(trace[place.critical_load_N]! || model.critical_load_N, 2);
  const rupture = newtons(model.rupture_force_N, 2);
  const free = millimetres(trace[place.free_length_m]!, 0);
  const rigid = model.scene.tissue?.rigid === true;
  if (stage === 'buckled') {
    return {
      title: 'It buckled.',
      text: rigid
        ? `A straight needle of ${free} carries ${critical}; beyond that it gives way sideways.`
        : `${free} of free needle carry ${critical}, then give way sideways; the tissue opens only at ${rupture}. Pushing on mostly bends it.`,
      offer: shorter(model),
    };
  }
  if (stage === 'inserted_buckled')
    return {
      title: 'It buckled again, with its tip inside.',
      text: `Cutting and friction now ask for more than the ${critical} that the ${free} outside can carry.`,
    };
  if (stage === 'inserted' && trace[place.hand_force_N]! < 0)
    return { title: 'You are pulling it out.', text: 'Friction along the channel now holds the needle back: the force has turned.' };
  if (stage === 'inserted')
    return {
      title: happened.has('second_buckling') || happened.has('buckling') ? 'It broke through after all.' : 'It went in straight.',
      text: `The surface opened at ${rupture}. Only ${free} is left outside, which carries ${critical}; what the hand feels now is cutting and friction.`,
    };
  if (stage === 'withdrawn') return { title: 'Out again.', text: 'The channel stays: the same path needs no cutting a second time.' };
  if (moved && stage === 'contact')
    return rigid
      ? { title: 'Keep pushing.', text: `The needle stands on a wall; it will bow at ${critical}.` }
      : { title: 'Keep pushing.', text: `The tissue gives way and pushes back. It opens at ${rupture}; the needle stays straight up to ${critical}.` };
  if (device !== null) return { title: 'Push the needle.', text: `The handle of the ${device} is its hub: push it towards the tissue. You feel it once it is armed, on the left.` };
  return { title: 'Push the needle.', text: 'Pull its hub down in the picture, press “Steady hand” and watch, or hold the down arrow key.' };
}

const margin = 0.97; // of the longest that should stay straight

function shorter(model: Model): Story['offer'] {
  const length = model.scene.needle?.length_mm;
  if (typeof length !== 'number' || model.scene.tissue?.rigid === true) return undefined;
  const straight = Math.floor((margin * model.longest_straight_m * 1e3) / 10) * 10;
  if (!(straight >= 20) || straight >= length) return undefined;
  return { words: `Try ${straight} mm, which stays straight`, settings: { 'needle.length_mm': straight } };
}
