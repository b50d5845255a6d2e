import { describe, expect, test } from "vitest";
import type { LabelledChange, WorldFact, WorldWrite } from "../src/api/types";
import { graphOf, mostRelated } from "../src/state/neighbours";
import { differencesOf, editsOf } from "../src/state/world_changes";

const iri = (name: string) => ({ type: "iri" as const, iri: `http://lab#${name}`, label: `lab:${name}` });
const contain = { type: "iri" as const, iri: "http://skiros#contain", label: "skiros:contain" };
const frame = { type: "iri" as const, iri: "http://skiros#FrameId", label: "skiros:FrameId" };
const holds = (subject: string, object: string, does = true): LabelledChange => ({
  type: "relation",
  subject: iri(subject),
  relation: contain,
  object: iri(object),
  holds: does,
});
const named = (value: string | null): LabelledChange => ({
  type: "property",
  individual: iri("Box"),
  property: frame,
  value,
});
const write = (sequence: number, changes: LabelledChange[], undo: LabelledChange[]): WorldWrite => ({
  sequence,
  written_ns: 0,
  origin: `admin: ${sequence}`,
  evidence: null,
  changes,
  undo,
});

describe("edits that undo a change", () => {
  test("state what was before", () => {
    expect(editsOf([holds("A", "Box"), holds("B", "Box", false), named("old")], [])).toEqual([
      "lab:A contain lab:Box",
      "not lab:B contain lab:Box",
      'lab:Box.FrameId == "old"',
    ]);
  });

  test("remove a value that was stated first", () => {
    expect(editsOf([named(null)], [named("new")])).toEqual(['not lab:Box.FrameId == "new"']);
  });

  test("do not exist for what no edit can state", () => {
    const vector: LabelledChange = {
      type: "property",
      individual: iri("Box"),
      property: frame,
      value: { type: "list", values: [1, 2] },
    };
    expect(editsOf([holds("A", "Box"), vector], [])).toBeNull();
    expect(editsOf([], [])).toBeNull();
  });
});

test("what differs between two times is what was before the first write and after the last", () => {
  const moved = write(
    1,
    [holds("B", "Box"), holds("A", "Box", false)],
    [holds("B", "Box", false), holds("A", "Box")],
  );
  const back = write(
    2,
    [holds("A", "Box"), holds("B", "Box", false)],
    [holds("A", "Box", false), holds("B", "Box")],
  );
  const name = write(3, [named("two")], [named("one")]);
  expect(differencesOf([moved, back])).toEqual([]);
  const found = differencesOf([moved, name]);
  expect(found.map((each) => [each.what, each.before, each.after])).toEqual([
    ["lab:B contain lab:Box", "no", "yes"],
    ["lab:A contain lab:Box", "yes", "no"],
    ["lab:Box.FrameId", '"one"', '"two"'],
  ]);
  expect(found[2]?.by).toBe("admin: 3");
});

describe("the graph around an individual", () => {
  const facts: WorldFact[] = Array.from({ length: 20 }, (_, at) => ({
    fact: { type: "relation", subject: iri("Hall"), relation: contain, object: iri(`Box-${at}`) },
  }));

  test("has the individual with the most relations in the middle, and leaves out what has no room", () => {
    const centre = mostRelated(facts);
    expect(centre).toBe(iri("Hall").iri);
    const graph = graphOf(facts, centre ?? "", 600, 400);
    expect(graph?.nodes[0]).toMatchObject({ label: "lab:Hall", x: 300, y: 200 });
    expect(graph?.edges.length).toBe((graph?.nodes.length ?? 0) - 1);
    expect((graph?.omitted ?? 0) + (graph?.edges.length ?? 0)).toBe(20);
  });

  test("says how many more relations a neighbour has", () => {
    expect(graphOf(facts, iri("Box-3").iri, 600, 400)?.nodes.map((each) => each.more)).toEqual([0, 19]);
    expect(graphOf(facts, "http://lab#Nobody", 600, 400)).toBeNull();
  });
});
