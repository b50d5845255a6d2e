// The relations around one individual, laid out as a picture: it in the middle, what it is related to around it.
import type { LabelledIri, WorldFact } from "../api/types";
import { individualsOf, localName } from "./text";

export interface GraphNode {
  iri: string;
  label: string;
  x: number;
  y: number;
  /** How many relations it has that are not drawn. */
  more: number;
}

export interface GraphEdge {
  from: GraphNode;
  to: GraphNode;
  label: string;
}

export interface Graph {
  nodes: readonly GraphNode[];
  edges: readonly GraphEdge[];
  /** How many neighbours are left out. */
  omitted: number;
}

interface Relation {
  from: LabelledIri;
  to: LabelledIri;
  name: string;
}
const MOST = 14;

function relationsOf(facts: readonly WorldFact[]): Relation[] {
  return facts.flatMap(({ fact }) =>
    fact.type === "relation" && fact.subject !== null && fact.object !== null && fact.holds !== false
      ? [{ from: fact.subject, to: fact.object, name: localName(fact.relation.iri) }]
      : [],
  );
}

/** Return the individual that is shown if none is selected: the one with the most relations. */
export function mostRelated(facts: readonly WorldFact[]): string | null {
  const counts = new Map<string, number>();
  for (const { fact } of facts)
    if (fact.type === "relation")
      for (const each of individualsOf(fact)) counts.set(each.iri, (counts.get(each.iri) ?? 0) + 1);
  return (
    [...counts.entries()].sort((one, other) => other[1] - one[1] || one[0].localeCompare(other[0]))[0]?.[0] ??
    null
  );
}

/** Return the picture of an individual, `width` by `height`; null if no fact names it. */
export function graphOf(
  facts: readonly WorldFact[],
  centre: string,
  width: number,
  height: number,
): Graph | null {
  const relations = relationsOf(facts);
  const own = relations.filter((each) => each.from.iri === centre || each.to.iri === centre);
  const known = facts.flatMap((each) => individualsOf(each.fact)).find((each) => each.iri === centre);
  if (known === undefined) return null;
  const others = new Map<string, LabelledIri>();
  for (const each of own)
    others.set(
      each.from.iri === centre ? each.to.iri : each.from.iri,
      each.from.iri === centre ? each.to : each.from,
    );
  others.delete(centre);
  const shown = [...others.values()]
    .sort((one, other) => one.label.localeCompare(other.label))
    .slice(0, MOST);
  const [middleX, middleY] = [width / 2, height / 2];
  const drawn = new Set([centre, ...shown.map((each) => each.iri)]);
  const moreOf = (iri: string): number =>
    relations.filter(
      (each) =>
        (each.from.iri === iri || each.to.iri === iri) &&
        !(drawn.has(each.from.iri) && drawn.has(each.to.iri)),
    ).length;
  const nodes: GraphNode[] = [
    { ...known, x: middleX, y: middleY, more: 0 },
    ...shown.map((each, index) => {
      const angle = -Math.PI / 2 + ((index + 0.5) / shown.length) * 2 * Math.PI;
      const [x, y] = [
        middleX + Math.cos(angle) * (width / 2 - 84),
        middleY + Math.sin(angle) * (height / 2 - 22),
      ];
      return { iri: each.iri, label: each.label, x, y, more: moreOf(each.iri) };
    }),
  ];
  const byIri = new Map(nodes.map((each) => [each.iri, each]));
  const edges = new Map<string, GraphEdge>();
  for (const each of relations) {
    const [from, to] = [byIri.get(each.from.iri), byIri.get(each.to.iri)];
    if (from === undefined || to === undefined || from === to) continue;
    const key = `${from.iri} ${to.iri}`;
    const before = edges.get(key);
    edges.set(key, { from, to, label: before === undefined ? each.name : `${before.label}, ${each.name}` });
  }
  return { nodes, edges: [...edges.values()], omitted: others.size - shown.length };
}
