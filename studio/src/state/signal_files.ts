// Signals as files: a table, and a drawing of what is plotted.
import type { Plotted } from "./signals";

/** Return a plot as a table with a row for each time; what is not known is empty. */
export function writeCsv({ lines, columns }: Plotted): string {
  const quote = (text: string): string => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
  const head = ["time [s]", ...lines.map((each) => `${each.name} [${each.unit}]`)].map(quote);
  const rows = (columns[0] ?? []).map((_, row) => columns.map((each) => each[row] ?? "").join(","));
  return `${[head.join(","), ...rows].join("\n")}\n`;
}

const [WIDTH, HEIGHT, LEFT, TOP, LABEL] = [960, 180, 64, 28, 18];
const COLOURS = ["#0b62c4", "#b3541e", "#1a7f4b", "#8a3fb0", "#a3112b", "#5b6570"];

/** Return a plot as a drawing, a field for each unit, between two times in s. */
export function drawSvg({ lines, columns }: Plotted, [from, to]: readonly [number, number]): string {
  const units = [...new Set(lines.map((each) => each.unit))];
  const fields = units.map((unit, index) => {
    const chosen = lines.flatMap((line, at) =>
      line.unit === unit ? [{ line, values: columns[at + 1] ?? [] }] : [],
    );
    return drawField(unit, chosen, columns[0] ?? [], [from, to], index * (HEIGHT + 3 * LABEL));
  });
  const height = units.length * (HEIGHT + 3 * LABEL) + TOP;
  return (
    `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${WIDTH} ${height}" font-family="sans-serif" font-size="12">` +
    `<rect width="${WIDTH}" height="${height}" fill="white"/>${fields.join("")}</svg>\n`
  );
}

interface Drawn {
  line: { name: string };
  values: readonly (number | null)[];
}

function drawField(
  unit: string,
  drawn: readonly Drawn[],
  times: readonly (number | null)[],
  [from, to]: readonly [number, number],
  top: number,
): string {
  const isShown = times.map((each) => each !== null && each >= from && each <= to);
  const known = drawn.flatMap(({ values }) => values.filter((each, row) => each !== null && isShown[row]));
  const most = known.reduce((found: number, each) => Math.max(found, each ?? 0), 0.1);
  const x = (time: number): number =>
    LEFT + ((time - from) / Math.max(to - from, 1e-9)) * (WIDTH - LEFT - 16);
  const y = (value: number): number => top + TOP + HEIGHT - (value / most) * HEIGHT;
  const labels = [0, 0.5, 1].map(
    (share) =>
      `<path d="M${LEFT} ${y(share * most)}H${WIDTH - 16}" stroke="#ccc"/>` +
      `<text x="${LEFT - 6}" y="${y(share * most) + 4}" text-anchor="end">${format(share * most)} ${unit}</text>` +
      `<text x="${x(from + share * (to - from))}" y="${top + TOP + HEIGHT + LABEL}" text-anchor="middle">${format(from + share * (to - from))} s</text>`,
  );
  const paths = drawn.map(({ line, values }, index) => {
    const colour = COLOURS[index % COLOURS.length] ?? "black";
    const name = `<text x="${LEFT + index * 220}" y="${top + TOP - 10}" fill="${colour}">${escape(line.name)}</text>`;
    return `${name}<path fill="none" stroke="${colour}" d="${trace(times, values, isShown, x, y)}"/>`;
  });
  return labels.join("") + paths.join("");
}

/** Return the path of a line; a gap ends it, and the next value begins another piece. */
function trace(
  times: readonly (number | null)[],
  values: readonly (number | null)[],
  isShown: readonly boolean[],
  x: (time: number) => number,
  y: (value: number) => number,
): string {
  let pen = "M";
  return times
    .map((time, row) => {
      const value = values[row] ?? null;
      const point =
        time === null || value === null || !isShown[row]
          ? ""
          : `${pen}${x(time).toFixed(1)} ${y(value).toFixed(1)}`;
      pen = point === "" ? "M" : "L";
      return point;
    })
    .join("");
}

const format = (value: number): string => String(Number(value.toPrecision(3)));

const escape = (text: string): string => text.replaceAll("&", "&amp;").replaceAll("<", "&lt;");
