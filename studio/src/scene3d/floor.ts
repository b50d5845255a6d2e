// The floor: a grid of 1 m, and of 10 cm near the origin, that fades into the distance, and the axes of the world.
import * as three from "three";
import type { SceneTheme } from "./theme";

const SIZE_M = 12;
const FINE_M = 5;
/** How strong lines of 10 cm are; those of 1 m are stronger than the limit. */
const [FINE, LIMIT] = [0.08, 0.1];
const AXIS_M = 0.5;
const [AXIS_X, AXIS_Y] = [new three.Color(0.75, 0.08, 0.08), new three.Color(0.05, 0.45, 0.12)];

/** Return the floor: lines, as shading the whole plane is slow in software; short ones, which all browsers clip well. */
export function makeFloor(
  theme: SceneTheme,
): three.LineSegments<three.BufferGeometry, three.LineBasicMaterial> {
  const [ends, colours]: [number[], number[]] = [[], []];
  const add = (line: [number, number, number, number], colour: three.Color, opacity: number): void => {
    ends.push(line[0], line[1], 0, line[2], line[3], 0);
    for (let end = 0; end < 2; end++) colours.push(colour.r, colour.g, colour.b, opacity);
  };
  const strength = theme.isDark ? 0.17 : 0.14;
  for (let at = -SIZE_M; at <= SIZE_M; at++)
    for (let from = -SIZE_M; from < SIZE_M; from++) {
      add([at, from, at, from + 1], theme.ink, strength);
      add([from, at, from + 1, at], theme.ink, strength);
    }
  for (let at = -10 * FINE_M; at <= 10 * FINE_M; at++)
    for (let from = -FINE_M; from < FINE_M && at % 10 !== 0; from++) {
      add([at / 10, from, at / 10, from + 1], theme.ink, FINE);
      add([from, at / 10, from + 1, at / 10], theme.ink, FINE);
    }
  add([0, 0, AXIS_M, 0], AXIS_X, 0.7);
  add([0, 0, 0, AXIS_M], AXIS_Y, 0.7);
  const geometry = new three.BufferGeometry();
  geometry.setAttribute("position", new three.Float32BufferAttribute(ends, 3));
  geometry.setAttribute("color", new three.Float32BufferAttribute(colours, 4));
  const material = new three.LineBasicMaterial({ vertexColors: true, transparent: true, depthWrite: false });
  material.onBeforeCompile = fade;
  return new three.LineSegments(geometry, material);
}

/** Let lines fade with the distance from the origin; those of 10 cm also where they would be too close together. */
function fade(shader: three.WebGLProgramParametersWithUniforms): void {
  shader.vertexShader = shader.vertexShader
    .replace("#include <common>", "#include <common>\nvarying vec3 vPlace;")
    .replace("#include <begin_vertex>", "#include <begin_vertex>\nvPlace = position;");
  shader.fragmentShader = shader.fragmentShader
    .replace("#include <common>", "#include <common>\nvarying vec3 vPlace;")
    .replace(
      "#include <opaque_fragment>",
      `float away = distance(cameraPosition, vPlace);
       bool fine = vColor.a < ${LIMIT.toFixed(2)};
       float end = fine ? ${FINE_M.toFixed(1)} : ${SIZE_M.toFixed(1)};
       diffuseColor.a *= 1.0 - smoothstep(0.2 * end, end, length(vPlace.xy));
       if (fine) diffuseColor.a *= 1.0 - smoothstep(4.0, 10.0, away);
       #include <opaque_fragment>`,
    );
}
