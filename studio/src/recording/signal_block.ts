// Samples of signals as recordings have them: columns of whole numbers, stored as differences; docs/recording.md has the form.

type Column = [quantum: number, width: number, order: number, first: number[], data: Uint8Array];

export interface SignalBlock {
  first_ns: number;
  period_ns: number;
  rows: number;
  columns: Column[];
}

/** Return the values of a column (rows,); an error if it is damaged. */
export function decodeColumn([quantum, width, order, first, data]: Column, rows: number): Float64Array {
  if (width === 0) return decodeFloats(data, rows);
  if (first.length !== order || data.length !== (rows - order) * width)
    throw new Error("a column of an unknown form");
  let values = new Float64Array(rows - order);
  for (let at = 0; at < values.length; at++) values[at] = zigzagAt(data, at, values.length, width);
  for (const before of [...first].reverse()) values = sums(before, values);
  return values.map((each) => each * quantum);
}

function decodeFloats(data: Uint8Array, rows: number): Float64Array {
  if (data.length !== rows * 8) throw new Error("a column of an unknown length");
  const view = new DataView(data.buffer, data.byteOffset, data.byteLength);
  return Float64Array.from({ length: rows }, (_, at) => view.getFloat64(at * 8, true));
}

/** Return a zigzag number whose bytes are `count` apart, the lowest first. Differences are less than 2^41. */
function zigzagAt(data: Uint8Array, at: number, count: number, width: number): number {
  let number = 0;
  for (let byte = width - 1; byte >= 0; byte--) number = number * 256 + (data[byte * count + at] ?? 0);
  return number % 2 === 0 ? number / 2 : -(number + 1) / 2;
}

function sums(before: number, differences: Float64Array): Float64Array<ArrayBuffer> {
  const values = new Float64Array(differences.length + 1);
  values[0] = before;
  for (let at = 0; at < differences.length; at++) values[at + 1] = (values[at] ?? 0) + (differences[at] ?? 0);
  return values;
}
