// The shapes of a body as one geometry with a colour at each point, so that a body is drawn at once.
import * as three from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";
import type { Body, CellModel, Geom, Mesh, PoseNumbers } from "./types";

const AROUND = 24;
const OPAQUE = 0.99;

/** Return the geometry of the shapes of a body that are opaque, or are not; null if there are none. Planes are floor. */
export function makeBodyGeometry(model: CellModel, body: Body, opaque: boolean): three.BufferGeometry | null {
  const shown = body.geoms.filter((geom) => geom.shape !== "plane" && geom.colour[3] >= OPAQUE === opaque);
  const parts = shown.map((geom) => makeGeometry(geom, model.meshes));
  return parts.length === 0 ? null : mergeGeometries(parts);
}

function makeGeometry(geom: Geom, meshes: readonly Mesh[]): three.BufferGeometry {
  const geometry = makeShape(geom, meshes);
  for (const name of Object.keys(geometry.attributes))
    if (name !== "position" && name !== "normal") geometry.deleteAttribute(name);
  geometry.applyMatrix4(matrixOf(geom.pose));
  const count = geometry.getAttribute("position").count;
  const colour = new three.Color().setRGB(
    geom.colour[0],
    geom.colour[1],
    geom.colour[2],
    three.SRGBColorSpace,
  );
  const colours = new Float32Array(count * 4);
  for (let index = 0; index < count; index++)
    colours.set([colour.r, colour.g, colour.b, geom.colour[3]], 4 * index);
  geometry.setAttribute("color", new three.BufferAttribute(colours, 4));
  return geometry;
}

function makeShape({ shape, size, mesh }: Geom, meshes: readonly Mesh[]): three.BufferGeometry {
  const [x, y, z] = size;
  switch (shape) {
    case "box":
      return new three.BoxGeometry(2 * x, 2 * y, 2 * z);
    case "sphere":
      return new three.SphereGeometry(x, AROUND, AROUND / 2);
    case "ellipsoid":
      return new three.SphereGeometry(1, AROUND, AROUND / 2).scale(x, y, z);
    case "cylinder":
      return new three.CylinderGeometry(x, x, 2 * y, AROUND).rotateX(Math.PI / 2);
    case "capsule":
      return new three.CapsuleGeometry(x, 2 * y, 6, AROUND).rotateX(Math.PI / 2);
    case "mesh":
      return makeMesh(meshes[mesh ?? -1]);
    case "plane":
      return new three.PlaneGeometry(2 * (x || 1), 2 * (y || 1));
  }
}

/** Return a mesh with flat faces, as data of points has no normals. */
function makeMesh(mesh: Mesh | undefined): three.BufferGeometry {
  const indexed = new three.BufferGeometry();
  indexed.setAttribute("position", new three.Float32BufferAttribute(mesh?.points ?? [], 3));
  indexed.setIndex([...(mesh?.triangles ?? [])]);
  const flat = indexed.toNonIndexed();
  flat.computeVertexNormals();
  flat.setIndex(Array.from({ length: flat.getAttribute("position").count }, (_, index) => index));
  return flat;
}

/** Return the matrix of a pose. */
export function matrixOf(pose: PoseNumbers, into = new three.Matrix4()): three.Matrix4 {
  position.set(pose[0], pose[1], pose[2]);
  turn.set(pose[4], pose[5], pose[6], pose[3]);
  return into.compose(position, turn, UNIT);
}
const position = new three.Vector3();
const turn = new three.Quaternion();
const UNIT = new three.Vector3(1, 1, 1);

/** Replace the normals by those that points at the same place share, so that a hull along them has no gaps. */
export function shareNormals(geometry: three.BufferGeometry): three.BufferGeometry {
  const points = geometry.getAttribute("position");
  const normals = geometry.getAttribute("normal");
  const sums = new Map<string, three.Vector3>();
  const keys = Array.from({ length: points.count }, (_, index) =>
    [points.getX(index), points.getY(index), points.getZ(index)].map((each) => Math.round(each * 1e5)).join(),
  );
  keys.forEach((key, index) => {
    const sum = sums.get(key) ?? new three.Vector3();
    sums.set(key, sum.add(position.fromBufferAttribute(normals, index)));
  });
  keys.forEach((key, index) => {
    const { x, y, z } = sums.get(key)?.normalize() ?? UNIT;
    normals.setXYZ(index, x, y, z);
  });
  return geometry;
}
