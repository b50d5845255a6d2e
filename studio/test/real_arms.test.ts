// A real arm in words and numbers.
import { expect, test } from "vitest";
import { describeRate, describeSlider } from "../src/state/real_arms";
import type { ControlReport } from "../src/api/types";

const REPORT: ControlReport = {
  name: "lab:Arm-1",
  state: "in-control",
  sentence: "",
  period_s: 0.001,
  rate_hz: 999.7,
  late_s: 0.00042,
  lost_periods: 0,
  speed_share: 1,
  real_time: false,
};

test("a rate has the latest begin of a period beside it", () => {
  expect(describeRate(REPORT)).toBe("1000 Hz, late by 0.4 ms");
  expect(describeRate({ ...REPORT, late_s: 0.0321 })).toBe("1000 Hz, late by 32 ms");
  expect(describeRate({ ...REPORT, rate_hz: null, late_s: null })).toBe("");
});

test("a slider is shown only if it slows the arm down", () => {
  expect(describeSlider(REPORT)).toBe("");
  expect(describeSlider({ ...REPORT, speed_share: 0.3 })).toBe("speed 30 %");
});
