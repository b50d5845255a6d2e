import { expect, test } from "vitest";
import type { OperationStatus } from "../src/api/types";
import { describeTimes, formatMoment } from "../src/state/run_times";

const at = (second: string): string => `2026-01-31T12:00:${second}Z`;

test("times are said as far as they are known, and how long it took when it has ended", () => {
  const queued = { submitted_at: at("00"), started_at: null, ended_at: null } as OperationStatus;
  const running = { ...queued, started_at: at("02") };
  const ended = { ...running, ended_at: at("07") };
  expect(describeTimes(queued)).toMatch(/^submitted (?!.*(started|ended))/);
  expect(describeTimes(running)).toMatch(/^submitted .*, started (?!.*ended)/);
  expect(describeTimes(ended)).toMatch(/^submitted .*, started .*, ended .* after 5\.0 s$/);
});

test("the day is said where it is another one", () => {
  const [evening, night] = [new Date("2026-01-31T23:59:00"), new Date("2026-02-01T00:01:00")];
  const short = formatMoment(night, night);
  expect(formatMoment(night, evening)).toContain(short);
  expect(formatMoment(night, evening).length).toBeGreaterThan(short.length);
});
