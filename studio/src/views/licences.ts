// The packages in the page, with their licences; a test compares them with package.json.
export const LICENCES: readonly [name: string, licence: string][] = [
  ["CodeMirror (@codemirror/*, @lezer/*)", "MIT"],
  ["fzstd (fzstd)", "MIT"],
  ["MCAP (@mcap/core)", "MIT"],
  ["MessagePack (@msgpack/msgpack)", "ISC"],
  ["Preact and signals (preact, @preact/signals)", "MIT"],
  ["three.js (three)", "MIT"],
  ["uPlot (uplot)", "MIT"],
];
