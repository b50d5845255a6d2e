// The floor: a grid of 10 cm and 1 m that fades into the distance, the axes of the world, and the shadows of what stands on it.
import * as three from "three";
import type { SceneTheme } from "./theme";

const SIZE_M = 12;

/** Return the floor; it is drawn at once. */
export function makeFloor(theme: SceneTheme): three.Mesh {
  const material = new three.ShadowMaterial({ opacity: theme.isDark ? 0.45 : 0.16, depthWrite: false });
  material.onBeforeCompile = (shader) => {
    shader.uniforms["lineColour"] = { value: theme.ink };
    shader.uniforms["lineOpacity"] = { value: theme.isDark ? 0.17 : 0.14 };
    shader.vertexShader = shader.vertexShader
      .replace("#include <common>", "#include <common>\nvarying vec3 vPlace;")
      .replace(
        "#include <begin_vertex>",
        "#include <begin_vertex>\nvPlace = (modelMatrix * vec4(position, 1.0)).xyz;",
      );
    shader.fragmentShader = shader.fragmentShader
      .replace("#include <common>", `#include <common>\n${GRID}`)
      .replace("#include <tonemapping_fragment>", `${BLEND}\n#include <tonemapping_fragment>`);
  };
  const mesh = new three.Mesh(new three.PlaneGeometry(2 * SIZE_M, 2 * SIZE_M), material);
  mesh.receiveShadow = true;
  mesh.renderOrder = -1;
  return mesh;
}

const GRID = `
  varying vec3 vPlace;
  uniform vec3 lineColour;
  uniform float lineOpacity;
  float lineShare(vec2 place, float step) {
    vec2 grid = abs(fract(place / step - 0.5) - 0.5) / fwidth(place / step);
    return 1.0 - min(min(grid.x, grid.y), 1.0);
  }
  float axisShare(float place) { return 1.0 - min(abs(place) / fwidth(place) / 1.2, 1.0); }`;

const BLEND = `
  float fade = 1.0 - smoothstep(2.0, ${SIZE_M.toFixed(1)}, length(vPlace.xy));
  float near = 1.0 - smoothstep(0.02, 0.06, max(fwidth(vPlace.x), fwidth(vPlace.y)));
  float line = max(lineShare(vPlace.xy, 1.0), 0.4 * near * lineShare(vPlace.xy, 0.1)) * lineOpacity * fade;
  vec4 above = vec4(lineColour, line);
  float alongX = axisShare(vPlace.y) * step(0.0, vPlace.x);
  float alongY = axisShare(vPlace.x) * step(0.0, vPlace.y);
  above = mix(above, vec4(0.75, 0.08, 0.08, 0.7 * fade), alongX * step(vPlace.x, 0.5));
  above = mix(above, vec4(0.05, 0.45, 0.12, 0.7 * fade), alongY * step(vPlace.y, 0.5));
  float opacity = above.a + gl_FragColor.a * (1.0 - above.a);
  gl_FragColor = vec4((above.rgb * above.a + gl_FragColor.rgb * gl_FragColor.a * (1.0 - above.a)) / max(opacity, 1e-4), opacity);`;
