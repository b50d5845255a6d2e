import { expect, test } from "vitest";
import { fixesFor } from "../src/state/goal_fixes";

const problem = (line: number, column: number, end: number, text: string) => ({
  name: "unknown-property",
  severity: "error" as const,
  path: "goal",
  line,
  column,
  end_line: line,
  end_column: end,
  message: "",
  help: "",
  labels: [],
  fix: {
    path: "goal",
    line,
    column,
    end_line: line,
    end_column: end,
    text,
    message: `write \`${text}\``,
    safe: false,
  },
});

test("each suggestion is the goal that it leads to", () => {
  const goal = "lab:A.Wieght == 2 kg\nand lab:B.isClaen == true";
  expect(fixesFor(goal, [problem(1, 7, 13, "Weight"), problem(2, 11, 18, "isClean")])).toEqual([
    { message: "write `Weight`", goal: "lab:A.Weight == 2 kg\nand lab:B.isClaen == true" },
    { message: "write `isClean`", goal: "lab:A.Wieght == 2 kg\nand lab:B.isClean == true" },
  ]);
  expect(fixesFor(goal, [{ ...problem(1, 1, 2, ""), fix: null }])).toEqual([]);
});
