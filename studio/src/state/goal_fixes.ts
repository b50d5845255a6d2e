// What the server suggests for a goal that has errors, as goals that can be taken with one click; pure functions.
import type { ProblemDetails } from "../api/types";

type Problem = NonNullable<ProblemDetails["diagnostics"]>[number];

export interface GoalFix {
  /** What the suggestion is, such as "write `lab:Goal`". */
  message: string;
  goal: string;
}

/** Return the suggestions for a goal, each with the goal that it leads to. */
export function fixesFor(goal: string, problems: readonly Problem[]): GoalFix[] {
  return problems.flatMap(({ fix }) => {
    if (fix === null || fix.path !== "goal") return [];
    const [from, to] = [offsetOf(goal, fix.line, fix.column), offsetOf(goal, fix.end_line, fix.end_column)];
    return [{ message: fix.message, goal: goal.slice(0, from) + fix.text + goal.slice(to) }];
  });
}

/** Return where a line and a column, which begin at 1, are in a text. */
function offsetOf(text: string, line: number, column: number): number {
  const before = text.split("\n").slice(0, line - 1);
  return before.reduce((sum, each) => sum + each.length + 1, 0) + column - 1;
}
