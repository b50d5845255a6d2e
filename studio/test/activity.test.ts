// What the strip shows: what wants a person first, then what goes on; what waits keeps its order.
import { expect, test } from "vitest";
import type { OperationStatus, Sample } from "../src/api/types";
import { describeRemaining, findActivities, movedBy, nameOperations } from "../src/state/activity";
import { operations, sample } from "../src/state/studio";

let number = 0;

function operation(state: string, changes: object = {}): OperationStatus {
  number += 1;
  return {
    id: `carry-20270104T0700${String(number).padStart(2, "0")}Z-00000${number}`,
    cell: "yard",
    request: { task: "carry" },
    state,
    place: 0,
    prompts: [],
    allowed: [],
    decisions: [],
    continued_by: "",
    ...changes,
  } as unknown as OperationStatus;
}

const shown = (all: OperationStatus[]): string[] =>
  findActivities(all).map(({ operation, attention }) => `${attention}: ${operation.state}`);

test("what wants a person comes before what goes on, and what waits last", () => {
  const prompt = { text: "Is it there?", choices: ["yes", "no"], ends_s: 60, default: "", id: 1 };
  const all = [
    operation("queued", { place: 2 }),
    operation("running"),
    operation("planning", { place: 1 }),
    operation("paused"),
    operation("running", { prompts: [prompt] }),
    operation("planned", { place: 3 }),
  ];
  expect(shown(all)).toEqual([
    "asks: running",
    "decides: paused",
    "decides: planned",
    "goes on: running",
    "waits: planning",
    "waits: queued",
  ]);
});

test("what was interrupted is shown until it is continued, given up, or something else has run", () => {
  const left = operation("interrupted", { decisions: ["replan"] });
  expect(shown([left])).toEqual(["interrupted: interrupted"]);
  expect(shown([{ ...left, continued_by: "other" }])).toEqual([]);
  expect(shown([{ ...left, decisions: [] }])).toEqual([]);
  expect(shown([left, operation("running")])).toEqual(["interrupted: interrupted", "goes on: running"]);
  expect(shown([left, operation("succeeded")])).toEqual([]);
});

test("an operation is moved by one place, and not beyond the ends", () => {
  expect(movedBy(["a", "b", "c"], "b", -1)).toEqual(["b", "a", "c"]);
  expect(movedBy(["a", "b", "c"], "b", 1)).toEqual(["a", "c", "b"]);
  expect(movedBy(["a", "b", "c"], "a", -1)).toEqual(["a", "b", "c"]);
  expect(movedBy(["a", "b", "c"], "d", 1)).toEqual(["a", "b", "c"]);
});

test("a question says how long it may be answered, and what counts then", () => {
  const prompt = { text: "", choices: ["yes"], ends_s: 60, default: "yes", id: 1 };
  sample.value = null;
  expect(describeRemaining(prompt)).toBe("");
  sample.value = { time_s: 18.4 } as unknown as Sample;
  expect(describeRemaining(prompt)).toBe("42 s left, then “yes” counts");
  expect(describeRemaining({ ...prompt, ends_s: 400, default: "" })).toBe(
    "6:22 min left, then the skill fails",
  );
  expect(describeRemaining({ ...prompt, ends_s: 18 })).toBe("the time to answer is over");
});

test("sentences call operations as people do, and leave what nobody knows", () => {
  const known = operation("running", { request: { task: "carry_all", owner: "ada" } });
  operations.value = new Map([[known.id, known]]);
  expect(nameOperations(`waits for the whole cell, which ${known.id} holds`)).toBe(
    "waits for the whole cell, which carry_all (ada) holds",
  );
  expect(nameOperations("waits for other-20270104T070000Z-abcdef")).toContain(
    "other-20270104T070000Z-abcdef",
  );
  operations.value = new Map();
});
