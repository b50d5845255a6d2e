// What robots can do, from the rows of two queries.
import { expect, test } from "vitest";
import { skillsOf } from "../src/state/skills";

test("a robot has what it can use and why it cannot use the rest", () => {
  const changes = [
    ["Ask", null],
    ["Grip", "hand contain object"],
    ["Grip", "not from contain object"],
  ];
  const implementations = [
    ["Grip", "lab:A", "Grip[wsg]", null],
    ["Grip", "lab:A", "Grip[robotiq]", "`hand` needs RobotiqGripper"],
    ["Grip", "lab:B", "Grip[wsg]", "there is no hand"],
  ];
  expect(skillsOf(changes, implementations)).toEqual([
    { name: "Ask", changes: [], robots: [] },
    {
      name: "Grip",
      changes: ["hand contain object", "not from contain object"],
      robots: [
        {
          robot: "lab:A",
          how: ["wsg"],
          rejections: [{ how: "robotiq", why: "`hand` needs RobotiqGripper" }],
        },
        { robot: "lab:B", how: [], rejections: [{ how: "wsg", why: "there is no hand" }] },
      ],
    },
  ]);
});
