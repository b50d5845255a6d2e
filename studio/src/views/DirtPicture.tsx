// A map of dirt as a picture, seen against the normal of its surface: x to the right, y up.
import { describeDirt, type DirtMap } from "../state/dirt_map";

const LEAST_OPACITY = 0.15;

/** Cells are the paler, the less certain they are; what was not seen stays empty. */
export function DirtPicture({ map, of }: { map: DirtMap; of: string }) {
  const said = describeDirt(map);
  return (
    <figure class="dirt-picture">
      <svg viewBox={`0 0 ${map.columns} ${map.rows}`} role="img" aria-label={`Map of ${of}: ${said}`}>
        <g transform={`translate(0 ${map.rows}) scale(1 -1)`} shape-rendering="crispEdges">
          {map.runs
            .filter((each) => each.state !== "unseen")
            .map((each) => (
              <rect
                key={`${each.row}-${each.column}`}
                class={each.state}
                x={each.column}
                y={each.row}
                width={each.length}
                height={1}
                opacity={Math.max(LEAST_OPACITY, 2 * each.sure - 1)}
              />
            ))}
        </g>
      </svg>
      <figcaption class="small muted">{said}; paler cells are less certain</figcaption>
    </figure>
  );
}
