// The trace as trace.csv has it: the same columns in the same order, numbers that read back to the bit.
import { columns, stageOf } from '../sources/frame';
import type { Recording } from '../sources/recording';

const written = (value: number): string => (Object.is(value, -0) ? '-0' : String(value));

export function traceCsv(run: Recording): string {
  const rows = run.traces.map((trace) => columns.map((name, i) => (name === 'stage' ? stageOf(trace) : written(trace[i]!))).join(','));
  return `${[columns.join(','), ...rows].join('\n')}\n`;
}
