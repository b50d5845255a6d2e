// What follows the `#` of an address.
import { expect, test } from "vitest";
import { readFragment, writeFragment } from "../src/state/address";

const NOTHING = { code: null, cell: null, task: null };

test.each([
  ["", NOTHING],
  ["#", NOTHING],
  ["#anything", NOTHING],
  ["#code=", NOTHING],
  ["#code=a-b_C", { ...NOTHING, code: "a-b_C" }],
  ["#code=c&cell=yard&task=carry_all", { code: "c", cell: "yard", task: "carry_all" }],
  ["#task=carry_all&code=c", { ...NOTHING, code: "c", task: "carry_all" }],
  ["#cell=Halle+3%26%C3%BC&other=1", { ...NOTHING, cell: "Halle 3&ü" }],
])("%s is taken apart", (fragment, asked) => {
  expect(readFragment(fragment)).toEqual(asked);
});

test("an address that is written is read as it was, without a code", () => {
  const wanted = { cell: "Halle 3&ü=#", task: "räumen" };
  expect(readFragment(writeFragment(wanted))).toEqual({ code: null, ...wanted });
  expect(writeFragment({ cell: null, task: null })).toBe("");
});
