// The materials of bodies: matt, their shadows on the floor, a ghost that shows its edges, and the hull that outlines what is selected.
import * as three from "three";
import { LIGHT } from "./lights";
import type { SceneTheme } from "./theme";

/** Return the material of what is really there. */
export function makeSolid(): three.Material {
  return new three.MeshLambertMaterial({ vertexColors: true });
}

export function makeTranslucent(): three.Material {
  return new three.MeshLambertMaterial({ vertexColors: true, transparent: true, depthWrite: false });
}

/** Return a material that is faint where a face looks at the viewer and strong at its rim. */
export function makeGhost(colour: three.Color): three.MeshLambertMaterial {
  const material = new three.MeshLambertMaterial({ color: colour, transparent: true, depthWrite: false });
  material.onBeforeCompile = (shader) => {
    shader.fragmentShader = shader.fragmentShader.replace(
      "#include <opaque_fragment>",
      `float rim = 1.0 - abs(dot(normalize(vNormal), normalize(vViewPosition)));
       diffuseColor.a = 0.22 + 0.6 * rim * rim;
       #include <opaque_fragment>`,
    );
  };
  return material;
}

/** Return the material of shadows: it draws bodies flat on the floor, away from the light, before anything else. */
export function makeShadow(theme: SceneTheme): three.Material {
  const colour = theme.ground.clone().lerp(new three.Color(0), theme.isDark ? 0.45 : 0.16);
  const material = new three.MeshBasicMaterial({ color: colour, depthTest: false, depthWrite: false });
  material.onBeforeCompile = (shader) => {
    shader.vertexShader = shader.vertexShader.replace(
      "#include <project_vertex>",
      `vec4 there = modelMatrix * batchingMatrix * vec4(transformed, 1.0);
       there.xy -= max(there.z, 0.0) * vec2(${(LIGHT.x / LIGHT.z).toFixed(4)}, ${(LIGHT.y / LIGHT.z).toFixed(4)});
       there.z = 0.0;
       vec4 mvPosition = viewMatrix * there;
       gl_Position = projectionMatrix * mvPosition;`,
    );
  };
  return material;
}

const OUTLINE_SHARE = 0.003;

/** Return a material that draws the back of a body, grown by a share of its distance: its outline. */
export function makeOutline(colour: three.Color): three.Material {
  const material = new three.MeshBasicMaterial({ color: colour, side: three.BackSide });
  material.onBeforeCompile = (shader) => {
    shader.vertexShader = shader.vertexShader.replace(
      "#include <project_vertex>",
      `#include <beginnormal_vertex>
       #ifdef USE_BATCHING
         vec3 outward = mat3(batchingMatrix) * objectNormal;
         vec3 place = (batchingMatrix * vec4(transformed, 1.0)).xyz;
       #else
         vec3 outward = objectNormal;
         vec3 place = transformed;
       #endif
       float away = length((modelViewMatrix * vec4(place, 1.0)).xyz);
       vec4 mvPosition = modelViewMatrix * vec4(place + outward * away * ${OUTLINE_SHARE}, 1.0);
       gl_Position = projectionMatrix * mvPosition;`,
    );
  };
  return material;
}
