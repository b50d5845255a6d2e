// A plot of lines over time with uPlot, in the colours of the theme; the selected span is shaded.
import type uPlot from "uplot";
import { colourLines, type Line } from "../state/series";

const FONT = "11px system-ui";
/** How many colours of lines a theme has. */
const COLOURS = 8;

/** Return a colour of the theme as the browser resolves it; canvas knows no variables. */
export const themeColour = (name: string): string => resolveColour(`var(--${name})`);

function resolveColour(colour: string): string {
  const probe = document.createElement("span");
  probe.style.color = colour;
  document.body.append(probe);
  const found = getComputedStyle(probe).color;
  probe.remove();
  return found;
}

/** Draw a plot into an element; `onPick` gets the time of a click, `span` what to shade. Rows without a value are gaps unless it has `spanGaps`. */
export async function drawPlot(
  element: HTMLElement,
  lines: readonly Line[],
  onPick: (time: number) => void,
  span: () => [number, number] | null,
  spanGaps = false,
): Promise<uPlot> {
  const { default: UPlot } = await import("uplot");
  const [ink, line, accent] = [themeColour("muted"), themeColour("line"), themeColour("accent")];
  const units = [...new Set(lines.map((each) => each.unit))];
  const colours = colourLines(lines).map((each, index) =>
    lineColour(`var(--line${(each % COLOURS) + 1})`, lines[index]?.isDashed === true),
  );
  // The marks of whole lines are full, those of dashed lines empty; the first series is the time.
  const fills = [
    "",
    ...lines.map((each, index) => (each.isDashed === true ? "transparent" : colours[index])),
  ];
  const axis = {
    stroke: ink,
    grid: { stroke: line, width: 1 },
    ticks: { stroke: line, width: 1 },
    font: FONT,
  };
  const options: uPlot.Options = {
    width: element.clientWidth,
    height: Math.max(80, element.clientHeight - 24),
    legend: { live: true, markers: { width: 2, dash: markStyle, fill: (_, index) => fills[index] ?? "" } },
    cursor: { drag: { x: true, y: false, setScale: true }, points: { size: 5 } },
    scales: {
      x: { time: false },
      ...Object.fromEntries(units.map((each) => [each, { auto: true, range: fromZero }])),
    },
    axes: [
      { ...axis, values: (_, ticks) => ticks.map((each) => `${each} s`), size: 28 },
      // eslint-disable-next-line @typescript-eslint/no-unsafe-enum-assignment -- the enum exists in types only
      ...units.map((unit, index) => ({
        ...axis,
        scale: unit,
        side: index === 0 ? 3 : 1,
        grid: { show: index === 0, stroke: line, width: 1 },
        values: (_: uPlot, ticks: number[]) => ticks.map((each) => `${each} ${unit}`),
        size: labelWidth,
      })),
    ],
    series: [
      { label: "time", value: (_, value) => format(value, "s") },
      ...lines.map((each, index) => ({
        label: each.name,
        scale: each.unit,
        stroke: colours[index] ?? ink,
        width: each.isDashed === true ? 2 : 1.5,
        spanGaps,
        ...(each.isDashed === true ? { dash: [5, 3] } : {}),
        value: (_: uPlot, value: number | null) => format(value, each.unit),
      })),
    ],
    hooks: { drawClear: [(plot) => shade(plot, span(), accent)], ready: [(plot) => pick(plot, onPick)] },
  };
  return new UPlot(options, [[], ...lines.map(() => [])] as uPlot.AlignedData, element);
}

/** Dashed lines are nearer to the text than what they are compared with, so that they are seen in its noise. */
const lineColour = (colour: string, isDashed: boolean): string =>
  resolveColour(isDashed ? `color-mix(in oklab, ${colour} 50%, var(--ink))` : colour);

const markStyle = (plot: uPlot, index: number): string =>
  plot.series[index]?.dash === undefined ? "solid" : "dashed";

/** The least height of an axis: noise around zero is not blown up. */
const LEAST = 0.1;

/** Return how wide an axis has to be for its labels, with the ticks beside them and some space at the edge. */
function labelWidth(plot: uPlot, values: string[] | null): number {
  if (values === null) return 40;
  plot.ctx.font = FONT;
  return 22 + Math.max(...values.map((each) => plot.ctx.measureText(each).width / devicePixelRatio));
}

/** Give a plot the size of its element without the legend, which is as wide as the element. */
export function fitPlot(plot: uPlot, element: HTMLElement): void {
  const legend = element.querySelector(".u-legend")?.clientHeight ?? 24;
  plot.setSize({ width: element.clientWidth, height: Math.max(80, element.clientHeight - legend) });
}

function fromZero(_: uPlot, least: number | null, most: number | null): [number, number] {
  return [Math.min(0, least ?? 0), Math.max(most ?? 0, LEAST) * 1.08];
}

function format(value: number | null, unit: string): string {
  return value == null ? `– ${unit}` : `${value.toFixed(2)} ${unit}`;
}

function shade(plot: uPlot, span: [number, number] | null, colour: string): void {
  if (span === null) return;
  const { left, top, width, height } = plot.bbox;
  const at = (time: number): number => Math.min(left + width, Math.max(left, plot.valToPos(time, "x", true)));
  const [from, to] = [at(span[0]), at(span[1])];
  plot.ctx.save();
  plot.ctx.fillStyle = colour;
  plot.ctx.globalAlpha = span[0] === span[1] ? 0.9 : 0.16;
  plot.ctx.fillRect(from, top, Math.max(2, to - from), height);
  plot.ctx.restore();
}

/** A click without a drag picks a moment. */
function pick(plot: uPlot, onPick: (time: number) => void): void {
  let downAt = 0;
  plot.over.addEventListener("pointerdown", (event) => (downAt = event.clientX));
  plot.over.addEventListener("click", (event) => {
    if (Math.abs(event.clientX - downAt) < 3) onPick(plot.posToVal(event.offsetX, "x"));
  });
}
