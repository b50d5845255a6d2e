// The relations of the selected individual as a picture; a click on another one puts that into the middle.
import { useLayoutEffect, useRef, useState } from "preact/hooks";
import { select } from "../state/actions";
import { graphOf, mostRelated, type GraphEdge, type GraphNode } from "../state/neighbours";
import { facts, things } from "../state/studio";

const [LETTERS, NODE] = [20, 22];
/** The least and the greatest size of the picture in px: its text has always the same. */
const [LEAST, MOST] = [
  { width: 380, height: 230 },
  { width: 1000, height: 640 },
];
/** What is around the picture in its element, in px. */
const MARGIN = 40;

interface Size {
  width: number;
  height: number;
}

/** Return how large a picture may be in an element. */
function sizeIn({ clientWidth, clientHeight }: HTMLElement): Size {
  return {
    width: Math.max(LEAST.width, Math.min(MOST.width, clientWidth - MARGIN / 2)),
    height: Math.max(LEAST.height, Math.min(MOST.height, clientHeight - MARGIN)),
  };
}

export function WorldGraph() {
  const box = useRef<HTMLElement>(null);
  const [{ width, height }, setSize] = useState<Size>(LEAST);
  const centre = things.value[0] ?? mostRelated(facts.value);
  const graph = centre === null ? null : graphOf(facts.value, centre, width, height);
  useLayoutEffect(() => {
    const element = box.current;
    if (element === null) return;
    const observer = new ResizeObserver(() => setSize(sizeIn(element)));
    observer.observe(element);
    return () => observer.disconnect();
  }, [graph === null]);
  if (graph === null)
    return (
      <div class="empty">
        No relation is known of this. Select a thing, and what it is related to is drawn here.
      </div>
    );
  return (
    <figure class="world-graph" ref={box}>
      <svg
        width={width}
        height={height}
        role="group"
        aria-label={`Relations of ${graph.nodes[0]?.label ?? ""}`}
      >
        {graph.edges.map((each) => (
          <Edge key={`${each.from.iri} ${each.to.iri}`} edge={each} />
        ))}
        {graph.nodes.map((each, index) => (
          <Node key={each.iri} node={each} isCentre={index === 0} />
        ))}
      </svg>
      {graph.omitted > 0 && (
        <figcaption class="small muted">{graph.omitted} more are not drawn; the table has them.</figcaption>
      )}
    </figure>
  );
}

function Edge({ edge: { from, to, label } }: { edge: GraphEdge }) {
  const [x, y] = [from.x + (to.x - from.x) * 0.55, from.y + (to.y - from.y) * 0.55];
  const angle = (Math.atan2(to.y - from.y, to.x - from.x) * 180) / Math.PI;
  return (
    <g class="graph-edge">
      <path d={`M${from.x} ${from.y}L${to.x} ${to.y}`} />
      <path class="arrow" d="M-4 -4L4 0L-4 4" transform={`translate(${x} ${y}) rotate(${angle})`} />
      <text x={x} y={y - 6} text-anchor="middle">
        {label.length > LETTERS ? `${label.slice(0, LETTERS)}…` : label}
        <title>{label}</title>
      </text>
    </g>
  );
}

function Node({ node, isCentre }: { node: GraphNode; isCentre: boolean }) {
  const text = node.label.length > LETTERS ? `${node.label.slice(0, LETTERS - 1)}…` : node.label;
  const width = text.length * 7 + 16;
  const act = (): void => select({ kind: "thing", iri: node.iri });
  return (
    <g
      class={`graph-node ${isCentre ? "is-centre" : ""}`}
      role="button"
      tabindex={0}
      aria-label={`${node.label}${node.more > 0 ? `, ${node.more} more relations` : ""}`}
      onClick={act}
      onKeyDown={(event) => {
        if (event.key !== "Enter" && event.key !== " ") return;
        event.preventDefault();
        act();
      }}
    >
      <title>{node.label}</title>
      <rect x={node.x - width / 2} y={node.y - NODE / 2} width={width} height={NODE} rx={4} />
      <text x={node.x} y={node.y + 4} text-anchor="middle">
        {text}
      </text>
      {node.more > 0 && <text class="more" x={node.x + width / 2 + 4} y={node.y + 4}>{`+${node.more}`}</text>}
    </g>
  );
}
