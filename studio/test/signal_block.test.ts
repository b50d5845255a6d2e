import { readFileSync } from "node:fs";
import { expect, test } from "vitest";
import { PlotColumns } from "../src/recording/plot_columns";
import { decodeColumn } from "../src/recording/signal_block";

// Columns that `encode_columns` of the runtime has made of `values`; each is stored in another form.
const fixture = JSON.parse(readFileSync(new URL("fixtures/signal_block.json", import.meta.url), "utf8")) as {
  rows: number;
  columns: [number, number, number, number[], string][];
  values: (number | null)[][];
};

test.each(fixture.columns.map((column, at) => [at, column] as const))(
  "column %d is decoded",
  (at, column) => {
    const [quantum, width, order, first, data] = column;
    const bytes = Uint8Array.from(atob(data), (letter) => letter.charCodeAt(0));
    const found = decodeColumn([quantum, width, order, first, bytes], fixture.rows);
    const expected = fixture.values[at] ?? [];
    expect(found.length).toBe(expected.length);
    expected.forEach((value, row) => {
      if (value === null) expect(found[row]).toBeNaN();
      else expect(Math.abs((found[row] ?? NaN) - value)).toBeLessThanOrEqual(quantum);
    });
  },
);

test("a damaged column is refused", () => {
  expect(() => decodeColumn([1, 1, 1, [0], new Uint8Array(3)], 10)).toThrow();
  expect(() => decodeColumn([1, 0, 0, [], new Uint8Array(3)], 10)).toThrow();
});

test("commands are beside what is measured", () => {
  const vectors = [
    "Arm/command/tool_v*_m_s",
    "Arm/estimate/tool_v*_m_s",
    "Arm/command/force_*_n",
    "Arm/sensor/force_*_n",
    "Eraser/truth/face_v*_m_s",
  ];
  const names = vectors.flatMap((each) =>
    ["x", "y", "z"].map((axis) => ({ column: each.replace("*", axis) })),
  );
  const plot = new PlotColumns(names);
  expect(plot.lines.map((each) => each.name)).toEqual([
    "commanded speed of Arm",
    "speed of Arm",
    "commanded force at Arm",
    "force at Arm",
    "speed of Eraser",
  ]);
});

test("the lengths of a force and a speed, and contact forces are plotted", () => {
  const plot = new PlotColumns(
    [
      "Arm/estimate/tool_vx_m_s",
      "Arm/estimate/tool_vy_m_s",
      "Arm/estimate/tool_vz_m_s",
      "Arm/sensor/force_x_n",
      "Arm/sensor/force_y_n",
      "Arm/sensor/force_z_n",
      "Tool/truth/contact_force_n",
      "Tool/truth/face_x_m",
    ].map((column) => ({ column })),
  );
  plot.add(
    [0, 1, 2],
    [
      [0.3, 0, 1],
      [0, 0, 0],
      [0.4, 0, 0],
      [3, 0, 0],
      [4, 0, 0],
      [0, 0, 2],
      [7, null, 9],
      [0, 0, 0],
    ],
    2,
  );
  expect(plot.lines.map((each) => each.name)).toEqual(["speed of Arm", "force at Arm", "contact of Tool"]);
  expect(plot.columns).toEqual([
    [0, 2],
    [0.5, 1],
    [5, 2],
    [7, 9],
  ]);
});
