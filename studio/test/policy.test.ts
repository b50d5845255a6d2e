import { expect, test } from "vitest";
import type { PreviewedBranch, PreviewedStep } from "../src/api/types";
import { previewRows } from "../src/state/policy";

const step = (skill: string): PreviewedStep => ({ skill, arguments: {}, source: "a.skill:1" });
const branch = (
  outcome: string,
  likely: number,
  plan: PreviewedStep[] | null,
  branches: PreviewedBranch[] = [],
): PreviewedBranch => ({ outcome, likely, plan, duration_s: 1, branches });
const written = (plan: PreviewedStep[], branches: PreviewedBranch[]): string[] =>
  previewRows({ plan, branches }).map(
    (row) => `${"  ".repeat(row.depth)}${row.kind === "step" ? `${row.number} ${row.step.skill}` : row.text}`,
  );

test("a plan has a row for each step", () => {
  expect(written([step("Pick"), step("Place")], [])).toEqual(["1 Pick", "2 Place"]);
  expect(written([], [])).toEqual([]);
});

test("branches are indented below what may come, and their steps are numbered on", () => {
  const scrap = branch("scrap", 0.1, []);
  const full = branch("full", 1 / 3, [step("Take")]);
  const good = branch("good", 0.9, [step("Bring"), step("Look")], [full, scrap]);
  expect(written([step("Look")], [good, branch("lost", 0.001, null)])).toEqual([
    "1 Look",
    "good (90 %)",
    "  2 Bring",
    "  3 Look",
    "  full (33.3 %)",
    "    4 Take",
    "  scrap (10 %)",
    "    nothing is left to do",
    "lost (0.1 %)",
    "  planned when it comes",
  ]);
});
