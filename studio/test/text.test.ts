import { describe, expect, test } from "vitest";
import type { Failure, LabelledFact } from "../src/api/types";
import {
  describeFailure,
  describePlan,
  describeReason,
  formatFact,
  formatNumber,
  formatTime,
  formatValue,
} from "../src/state/text";

const iri = (label: string) =>
  ({ type: "iri", iri: `http://example.org/lab#${label}`, label: `lab:${label}` }) as const;
const failure = (message: string, more: Partial<Failure> = {}): Failure => ({
  kind: "body",
  message,
  ...more,
});

test.each([
  [true, "true"],
  [3, "3"],
  ["home", '"home"'],
  [iri("A"), "lab:A"],
  [{ type: "quantity", value: 0.1 + 0.2, unit: "m" } as const, "0.3 m"],
  [{ type: "quantity", value: 2 } as const, "2"],
  [{ type: "vector", components: [2e-16, -0, 1], unit: "N" } as const, "(0, 0, 1) N"],
  [{ type: "list", values: [1, 2, 3, 4] } as const, "4 values"],
  [{ type: "not-finite", text: "inf N" } as const, "inf N"],
])("the value %j is %s", (value, text) => {
  expect(formatValue(value as Parameters<typeof formatValue>[0])).toBe(text);
});

test.each<[LabelledFact, string]>([
  [
    { type: "relation", subject: iri("A"), relation: iri("contain"), object: null, holds: false },
    "not lab:A contain _",
  ],
  [
    { type: "property", individual: iri("A"), property: iri("isClean"), value: true },
    "lab:A.isClean == true",
  ],
  [
    { type: "property", individual: iri("A"), property: iri("isClean"), value: null },
    "not lab:A has isClean",
  ],
  [{ type: "class", individual: iri("A"), cls: iri("Product") }, "lab:A is lab:Product"],
  [{ type: "same", one: iri("A"), other: iri("B"), holds: false }, "lab:A != lab:B"],
])("the fact %j is %s", (fact, text) => {
  expect(formatFact(fact)).toBe(text);
});

test("a plan is described by its proof, and by how much of it was checked in space", () => {
  const space = { checked: 4, steps: 5, unseen: [2, 2, 3].map((step) => ({ step, what: "Own" })) };
  expect([
    describePlan({ quality: "proved optimal", space: null }),
    describePlan({ quality: "proved optimal", space: { checked: 5, steps: 5 } }),
    describePlan({ quality: "", space }),
    describePlan({ space: { checked: 0, steps: 5, stopped: "it ran out of time" } }),
  ]).toEqual([
    "proved optimal",
    "proved optimal, all 5 checked in space",
    "2 of 5 checked in space",
    "not checked in space: it ran out of time",
  ]);
});

describe("a failure", () => {
  test("says its cause, then the other ways once, then what became of the plan", () => {
    const causes = [
      failure("slipped"),
      failure("slipped"),
      failure("too far", { alternative: "Pick[across]" }),
      failure("not told", { kind: "pre" }),
      failure("no other plan", { kind: "plan" }),
    ];
    expect(describeFailure(failure("slipped", { causes }))).toBe(
      "slipped; other ways were tried: Pick[across]: too far; no other plan",
    );
  });
  test("alone is its message", () => {
    expect(describeFailure(failure("slipped"))).toBe("slipped");
  });
});

test("numbers and times", () => {
  expect([formatNumber(1 / 3, 3), formatNumber(1e-9), formatTime(9.96), formatTime(125)]).toEqual([
    "0.333",
    "1e-9",
    "10.0 s",
    "2:05 min",
  ]);
});

test("a reason says first what becomes of a tool that pressed", () => {
  expect(describeReason({ reason: "coffee" })).toBe("coffee");
  expect(describeReason({ contact: "lifting" })).toBe("the tool is being taken off the surface");
  expect(describeReason({ reason: "coffee", contact: "taken-off" })).toMatch(
    /^the tool was taken off the surface.* \(coffee\)$/,
  );
});
