import { expect, test } from "vitest";
import type { OperationStatus } from "../src/api/types";
import { describeTimes } from "../src/state/run_times";

const at = (second: string): string => `2026-01-31T12:00:${second}Z`;

test("times are said as far as they are known, and how long it took when it has ended", () => {
  const queued = { submitted_at: at("00"), started_at: null, ended_at: null } as OperationStatus;
  const running = { ...queued, started_at: at("02") };
  const ended = { ...running, ended_at: at("07") };
  expect(describeTimes(queued)).toMatch(/^submitted [^,]*$/);
  expect(describeTimes(running)).toMatch(/^submitted .*, started [^,]*$/);
  expect(describeTimes(ended)).toMatch(/^submitted .*, started .*, ended .*: 5\.0 s$/);
});
