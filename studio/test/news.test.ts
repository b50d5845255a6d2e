// What is said of an operation, and what is known of it already.
import { expect, test } from "vitest";
import type { OperationStatus } from "../src/api/types";
import { isNews } from "../src/state/live";

const said = (state: OperationStatus["state"], events: number): OperationStatus =>
  ({ id: "run", state, events }) as OperationStatus;

test("an answer that comes after newer news changes nothing", () => {
  expect(isNews(undefined, said("planning", 1))).toBe(true);
  expect(isNews(said("running", 5), said("planning", 2))).toBe(false);
  expect(isNews(said("running", 5), said("paused", 6))).toBe(true);
  expect(isNews(said("running", 5), said("running", 5))).toBe(true);
});

test("an end stays, also one that nobody has counted the events of", () => {
  expect(isNews(said("succeeded", 9), said("running", 10))).toBe(false);
  expect(isNews(said("running", 10), said("interrupted", 0))).toBe(true);
});
