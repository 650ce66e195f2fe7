// The presets of the page, read from scenes/*.toml and studies/*.toml while it is built.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { parse, stringify, type TomlTable, type TomlValue } from 'smol-toml';
import type { Plugin } from 'vite';

const root = new URL('../../', import.meta.url);
const read = (path: string) => readFileSync(new URL(path, root), 'utf8');
const name = 'virtual:presets';

interface Built {
  id: string;
  group: string;
  title: string;
  words: string;
  toml: string;
}

// The comment at the head of a scene, as one paragraph.
const headWords = (toml: string) =>
  toml
    .split('\n')
    .slice(0, Math.max(0, toml.split('\n').findIndex((line) => !line.startsWith('#'))))
    .map((line) => line.replace(/^#\s?/, ''))
    .join(' ');

function scene(file: string, group: string, title: string): Built {
  const toml = read(`scenes/${file}.toml`);
  return { id: file, group, title, words: headWords(toml), toml };
}

const merged = (base: TomlTable, more: TomlTable): TomlTable => {
  const all: TomlTable = structuredClone(base);
  for (const [key, value] of Object.entries(more)) {
    const here = all[key];
    const both = value !== null && typeof value === 'object' && !Array.isArray(value) && here && typeof here === 'object';
    all[key] = both ? merged(here as TomlTable, value as TomlTable) : value;
  }
  return all;
};

interface Study {
  title: string;
  text: string;
  scene: TomlTable;
  run?: TomlTable[];
  axes?: Record<string, Record<string, TomlValue[]>>;
}
const study = (file: string) => parse(read(`studies/${file}.toml`)) as unknown as Study;

// One preset a run of a study that lists its runs.
function listedRuns(file: string, group: string, titles: Record<string, string>): Built[] {
  const { text, scene, run = [] } = study(file);
  return run.map((one) => {
    const { name, ...settings } = one;
    return { id: `${file}-${name}`, group, title: titles[String(name)] ?? String(name), words: text.trim(), toml: stringify(merged(scene, settings)) };
  });
}

// One preset a value of a study's axis, with the hub clamped as the paper's figure needs it.
function alongAxis(file: string, group: string, table: string, key: string, titleOf: (value: TomlValue) => string): Built[] {
  const { text, scene, axes } = study(file);
  const values = axes?.[table]?.[key] ?? [];
  return values.map((value) => ({
    id: `${file}-${value}`,
    group,
    title: titleOf(value),
    words: text.trim(),
    toml: stringify(merged(scene, { needle: { support: 'clamped_pinned', ...(table === 'needle' ? { [key]: value } : {}) } })),
  }));
}

function all(): Built[] {
  return [
    ...alongAxis('fig7a', 'The paper’s Fig. 7(a), by length', 'needle', 'length_mm', (v) => `Fig. 7(a): ${v} mm needle`),
    ...alongAxis('fig7b', 'The paper’s Fig. 7(b), by radius', 'needle', 'radius_mm', (v) => `Fig. 7(b): radius ${v} mm`),
    ...listedRuns('fig6', 'The paper’s Fig. 6, four stages of one push', {
      clamped_pinned: 'Fig. 6: hub clamped, 0.66 N',
      pinned_pinned: 'Fig. 6: hub pinned, 0.325 N',
    }),
    scene('default', 'Scenes', 'buckles, punctures, buckles again'),
    scene('pause_withdraw_reinsert', 'Scenes', 'stout needle, to go in, out and in again'),
    scene('bare_column', 'Scenes', 'bare needle against a wall'),
  ];
}

export function presets(): Plugin {
  return {
    name,
    resolveId: (id) => (id === name ? `\0${name}` : undefined),
    load(id) {
      if (id !== `\0${name}`) return undefined;
      for (const folder of ['scenes', 'studies']) this.addWatchFile(fileURLToPath(new URL(folder, root)));
      return `export default ${JSON.stringify(all())}`;
    },
  };
}
