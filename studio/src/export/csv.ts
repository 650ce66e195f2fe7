// The trace as trace.csv has it: the same columns in the same order, numbers that read back to the bit.
import { columns, stageOf, type Column } from '../sources/frame';
import type { Recording } from '../sources/recording';

const behind: Column = 'energy_grip_J'; // not a column of trace.csv

export function traceCsv(run: Recording): string {
  const kept = columns.filter((name) => name !== behind);
  const rows = run.traces.map((trace) => kept.map((name, i) => (name === 'stage' ? stageOf(trace) : String(trace[i]))).join(','));
  return `${[kept.join(','), ...rows].join('\n')}\n`;
}
