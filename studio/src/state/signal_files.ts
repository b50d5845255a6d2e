// Signals as files: a table, and a drawing of what is plotted.
import { colourLines, type Line } from "./series";
import type { Plotted } from "./plotted";

/** Return a plot as a table with a row for each time; what is not known is empty. */
export function writeCsv({ lines, columns }: Plotted): string {
  const quote = (text: string): string => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
  const head = ["time [s]", ...lines.map((each) => `${each.name} [${each.unit}]`)].map(quote);
  const rows = (columns[0] ?? []).map((_, row) => columns.map((each) => each[row] ?? "").join(","));
  return `${[head.join(","), ...rows].join("\n")}\n`;
}

const [WIDTH, HEIGHT, LEFT, TOP, LABEL] = [960, 180, 64, 28, 18];
const COLOURS = ["#00687d", "#944406", "#6d3fb0", "#3f7a12", "#a3266d", "#6b5b00", "#2457c5", "#4d5560"];
/** How many names stand beside each other, and how wide each is. */
const [NAMES, NAME] = [4, 220];

/** Return a plot as a drawing, a field for each unit, between two times in s. */
export function drawSvg({ lines, columns }: Plotted, [from, to]: readonly [number, number]): string {
  const units = [...new Set(lines.map((each) => each.unit))];
  const colours = colourLines(lines);
  let height = 0;
  const fields = units.map((unit) => {
    const chosen = lines.flatMap((line, at) =>
      line.unit === unit
        ? [
            {
              line,
              values: columns[at + 1] ?? [],
              colour: COLOURS[(colours[at] ?? 0) % COLOURS.length] ?? "",
            },
          ]
        : [],
    );
    const top = height + LABEL * (Math.ceil(chosen.length / NAMES) - 1);
    height = top + HEIGHT + 3 * LABEL;
    return drawField(unit, chosen, columns[0] ?? [], [from, to], top);
  });
  height += TOP;
  return (
    `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${WIDTH} ${height}" font-family="sans-serif" font-size="12">` +
    `<rect width="${WIDTH}" height="${height}" fill="white"/>${fields.join("")}</svg>\n`
  );
}

interface Drawn {
  line: Line;
  values: readonly (number | null)[];
  colour: string;
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
  const rows = Math.ceil(drawn.length / NAMES);
  const paths = drawn.map(({ line, values, colour }, index) => {
    const at = [
      LEFT + (index % NAMES) * NAME,
      top + TOP - 10 - LABEL * (rows - 1 - Math.floor(index / NAMES)),
    ];
    const name = `<text x="${at[0]}" y="${at[1]}" fill="${colour}">${escape(line.name)}</text>`;
    const dash = line.isDashed === true ? ' stroke-dasharray="5 3"' : "";
    return `${name}<path fill="none" stroke="${colour}"${dash} d="${trace(times, values, isShown, x, y)}"/>`;
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
