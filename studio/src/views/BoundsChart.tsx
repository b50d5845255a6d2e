// The best plan so far and the proved bound over the time of the planner: they grow towards each other.
import type { BoundPoint } from "../state/gantt";
import { formatTime } from "../state/text";

const [WIDTH, HEIGHT, FOOT] = [260, 72, 14];

export function BoundsChart({ points, costs }: { points: readonly BoundPoint[]; costs: boolean }) {
  const last = points.at(-1);
  const most = Math.max(...points.map((each) => Math.max(each.best ?? 0, each.least)));
  // A plan that is proved as soon as it is found says nothing over time.
  const compared = points.filter(({ best }) => best !== null).length;
  if (last === undefined || compared < 2 || most === 0) return null;
  const end = Math.max(last.at, 0.1);
  const x = (at: number): number => (at / end) * WIDTH;
  const y = (seconds: number): number => HEIGHT - (seconds / most) * (HEIGHT - 6);
  const line = (values: readonly (number | null)[]): string =>
    values
      .map((value, index) => {
        if (value === null) return "";
        const from = points[index]?.at ?? 0;
        const command = index > 0 && values[index - 1] !== null ? "V" : `M${x(from)} `;
        return `${command}${y(value)}H${x(points[index + 1]?.at ?? end)}`;
      })
      .join("");
  const say = (value: number): string => (costs ? `cost ${value}` : formatTime(value));
  return (
    <figure class="bounds">
      <svg
        viewBox={`0 0 ${WIDTH} ${HEIGHT + FOOT}`}
        role="img"
        aria-label={`After ${formatTime(last.at)} of planning: best plan ${last.best === null ? "none" : say(last.best)}, proved bound ${say(last.least)}`}
      >
        <path class="axis" d={`M0 ${HEIGHT}H${WIDTH}`} />
        <path class="best" d={line(points.map((each) => each.best))} />
        <path class="least" d={line(points.map((each) => each.least))} />
        <text x={0} y={HEIGHT + 12}>
          0 s
        </text>
        <text x={WIDTH} y={HEIGHT + 12} text-anchor="end">
          {formatTime(last.at)}
        </text>
      </svg>
      <figcaption class="row small">
        <span class="bounds-key best">best plan</span>
        <span class="bounds-key least">proved bound</span>
      </figcaption>
    </figure>
  );
}
