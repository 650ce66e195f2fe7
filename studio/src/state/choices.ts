// What can be chosen on the page: a control a scene key, with its range, and presets with their sources.

import needles from './needles.json'; // the engine's table, printed by `acus check --needles`

export interface Control {
  key: string;
  label: string;
  unit: string;
  least: number;
  most: number;
  step: number;
  digits: number;
  help?: string;
  also?: Record<string, number>; // what a change of it settles too
}

export interface Preset {
  words: string;
  settings: Record<string, number | string>;
  source: string;
}

export const needleControls: Control[] = [
  { key: 'needle.length_mm', label: 'Length', unit: 'mm', least: 40, most: 400, step: 5, digits: 0 },
  { key: 'needle.radius_mm', label: 'Radius', unit: 'mm', least: 0.1, most: 1.1, step: 0.005, digits: 3, help: 'solid; gauges are tubes', also: { 'needle.inner_radius_mm': 0 } },
];
export const tissueControls: Control[] = [
  { key: 'tissue.youngs_modulus_kPa', label: 'Stiffness', unit: 'kPa', least: 1, most: 100, step: 0.5, digits: 1, help: 'Young’s modulus' },
];
export const contactControls: Control[] = [
  { key: 'contact.rupture_force_N', label: 'Opens at', unit: 'N', least: 0.05, most: 3, step: 0.01, digits: 2, help: 'rupture force: tip force at which the surface gives way' },
  { key: 'contact.fracture_toughness_J_m2', label: 'Toughness', unit: 'J/m²', least: 0, most: 600, step: 2, digits: 0, help: 'work of cutting per area of crack' },
  { key: 'contact.friction_N_m', label: 'Friction', unit: 'N/m', least: 0, most: 200, step: 1, digits: 0, help: 'dry friction per inserted length' },
];

export const gauges: Preset[] = [
  { words: 'paper’s, 0.6 mm', settings: { 'needle.radius_mm': 0.3, 'needle.inner_radius_mm': 0 }, source: 'Table I, solid; 23 to 24 G outside' },
  ...needles.gauges.map(({ name, outer_diameter_mm: outer, inner_diameter_mm: inner }) => ({
    words: `${name.replace('G', ' G')}, ${outer.toFixed(2)} mm`,
    settings: { 'needle.radius_mm': outer / 2, 'needle.inner_radius_mm': inner / 2 },
    source: `tube with a bore of ${inner.toFixed(2)} mm; needle gauge chart, regular wall`,
  })),
];

export const materials: Preset[] = needles.materials.map((one) => ({
  words: `${one.words}, ${one.youngs_modulus_GPa} GPa`,
  settings: { 'needle.youngs_modulus_GPa': one.youngs_modulus_GPa, 'needle.density_kg_m3': one.density_kg_m3 },
  source: one.source.replace("'", '’'),
}));

// A column's tip has no side.
export const models: Preset[] = [
  { words: 'closed forms', settings: { 'needle.model': 'column', 'needle.bevel_deg': 0, 'guide.length_mm': 0 }, source: 'the paper’s; straight inside the tissue' },
  { words: 'elastic rod', settings: { 'needle.model': 'rod' }, source: 'bends outside and inside the tissue, with its mass' },
];
const bevel = (degrees: number): Preset => ({
  words: `bevel, ${degrees}°`,
  settings: { 'needle.bevel_deg': degrees, 'needle.model': 'rod' },
  source: 'steers to the side of its point; an elastic rod',
});
export const tips: Preset[] = [
  { words: 'symmetric', settings: { 'needle.bevel_deg': 0 }, source: 'the paper’s; goes straight' },
  bevel(30),
  bevel(20),
  bevel(12),
];

const support = (value: string, words: string, source: string): Preset => ({ words, settings: { 'needle.support': value }, source });
export const supports: Preset[] = [
  support('clamped_pinned', 'clamped, pinned', 'held fast by the hand, the tip rests in tissue'),
  support('pinned_pinned', 'pinned, pinned', 'free to tilt at both ends: the paper’s Eq. 10'),
  support('clamped_clamped', 'clamped, clamped', 'held fast at both ends'),
  support('clamped_free', 'clamped, free', 'held fast by the hand, the tip slides'),
];

const held = (millimetres: number, words: string, source: string): Preset => ({ words, settings: { 'hand.grip_mm': millimetres }, source });
export const grips: Preset[] = [
  held(0, 'at the hub', 'all of the needle is in front of the hand'),
  held(50, '50 mm down', 'the part behind the hand hangs free'),
  held(100, '100 mm down', 'the part behind the hand hangs free'),
];
const guide = (words: string, length: number, gap: number, stiffness: number, friction: number, source: string): Preset => ({
  words,
  settings: { 'guide.length_mm': length, 'guide.gap_mm': gap, 'guide.stiffness_MPa': stiffness, 'guide.friction_N_m': friction, 'needle.model': 'rod' },
  source,
});
export const guides: Preset[] = [
  { words: 'none', settings: { 'guide.length_mm': 0 }, source: 'nothing between hand and tissue' },
  guide('a second hand', 15, 20, 1, 10, 'two fingers 20 mm above the tissue; give and friction are a choice'),
  guide('a template, 10 mm', 10, 0, 1000, 0, 'a hole on the tissue: the needle cannot turn there'),
  guide('a sleeve, 60 mm', 60, 0, 1000, 0, 'stands on the tissue; the hand pushes it together'),
];

export const tissues: Preset[] = [
  {
    words: 'paper’s, 25 kPa',
    settings: { 'tissue.youngs_modulus_kPa': 25, 'contact.fracture_toughness_J_m2': 164, 'contact.friction_N_m': 40 },
    source: 'Table I; toughness of bovine liver (Gokgol 2012), friction J Endourol 10.1089/end.2016.0342',
  },
  {
    words: 'Easily cut, 25 kPa',
    settings: { 'tissue.youngs_modulus_kPa': 25, 'contact.fracture_toughness_J_m2': 76, 'contact.friction_N_m': 20 },
    source: 'toughness at the low end measured, porcine liver; as in studies/fig6.toml',
  },
  {
    words: 'Soft, 5 kPa',
    settings: { 'tissue.youngs_modulus_kPa': 5, 'contact.fracture_toughness_J_m2': 76, 'contact.friction_N_m': 20 },
    source: 'order of healthy liver under elastography; a choice to explore, not a measurement',
  },
  {
    words: 'Stiff, 60 kPa',
    settings: { 'tissue.youngs_modulus_kPa': 60, 'contact.fracture_toughness_J_m2': 300, 'contact.friction_N_m': 80 },
    source: 'order of fibrous tissue; a choice to explore, not a measurement',
  },
];

export const meshes = [
  { value: 1000, words: 'Coarse, 1 000: fastest' },
  { value: 3000, words: 'Medium, 3 000' },
  { value: 10000, words: 'The paper’s, 10 000: slow in a browser' },
];

// What the page sets on every scene so that a hand can push it in a browser; both are in reach of the person.
export const pageSettings: Record<string, number | string> = {
  'tissue.tetrahedra': 3000,
  'hand.speed_mm_s': 4, // a push goes five times as fast at most: the paper's 20 mm/s
  'run.solver_tolerance': 1e-6, // so that a way that is rounded to be written down leads to the same digits again
  'run.time_step_ms': 2, // moves no load of a first buckling or puncture by more than 0.2 % (docs/studio.md)
};

export const settingsList = (settings: Record<string, number | string>): string[] =>
  Object.entries(settings).map(([key, value]) => `${key}=${value}`);
