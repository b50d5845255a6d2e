// Where all bodies of a cell were, and how tools pressed, over time: what the 3-D view shows of a recording.
import type { PoseNumbers } from "../api/types";
import type { Sample } from "../scene3d/types";

interface Vector {
  x: number;
  y: number;
  z: number;
}
type Quaternion = Vector & { w: number };

/** What a message of `/frames` has: the poses of bodies in the world, by their names in the model. */
interface FrameTransforms {
  transforms: { child_frame_id: string; translation: Vector; rotation: Quaternion }[];
}

/** What a message of `/forces` has: an arrow along x of its pose for each tool that presses. */
interface SceneUpdate {
  entities: {
    id: string;
    arrows: { pose: { position: Vector; orientation: Quaternion }; shaft_length: number }[];
  }[];
}

/** How long the arrow of a force is in a recording. */
const M_PER_N = 0.005;

/** The pictures of a recording, in their order; a message is read when its time is shown. */
export class Film {
  private readonly times: number[] = [];
  private readonly frames: Uint8Array[] = [];
  private readonly forces: (Uint8Array | undefined)[] = [];

  addFrame(time: number, message: Uint8Array): void {
    this.times.push(time);
    this.frames.push(message);
  }

  /** Add the forces at the time of the last frame. */
  addForces(message: Uint8Array): void {
    this.forces[this.times.length - 1] = message;
  }

  /** Return the cell at times that are at least a step in s apart. */
  every(step: number): Sample[] {
    let next = -Infinity;
    return this.times.flatMap((time) => {
      if (time < next) return [];
      next = time + step;
      return this.sampleAt(time) ?? [];
    });
  }

  /** Return the cell at a time in s; null before the first picture. */
  sampleAt(time: number): Sample | null {
    const at = lastUpTo(this.times, time);
    const [frame, forces] = [this.frames[at], this.forces[at]];
    if (frame === undefined) return null;
    return {
      cell: "",
      time_s: this.times[at] ?? 0,
      arms: {},
      things: {},
      bodies: posesIn(parse(frame) as FrameTransforms),
      forces: forces === undefined ? {} : forcesIn(parse(forces) as SceneUpdate),
    };
  }
}

const parse = (message: Uint8Array): unknown => JSON.parse(new TextDecoder().decode(message));

/** Return the index of the last of ascending numbers that is at most `limit`; -1 if there is none. */
export function lastUpTo(numbers: readonly number[], limit: number): number {
  let [low, high] = [0, numbers.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((numbers[middle] ?? Infinity) <= limit) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

function posesIn({ transforms }: FrameTransforms): Record<string, PoseNumbers> {
  return Object.fromEntries(
    transforms.map(({ child_frame_id, translation: t, rotation: q }) => [
      child_frame_id,
      [t.x, t.y, t.z, q.w, q.x, q.y, q.z],
    ]),
  );
}

function forcesIn({ entities }: SceneUpdate): NonNullable<Sample["forces"]> {
  return Object.fromEntries(
    entities.flatMap(({ id, arrows }) =>
      arrows.map(({ pose: { position, orientation: q }, shaft_length }) => {
        const newtons = shaft_length / M_PER_N;
        const along = [
          1 - 2 * (q.y * q.y + q.z * q.z),
          2 * (q.x * q.y + q.w * q.z),
          2 * (q.x * q.z - q.w * q.y),
        ] as const;
        const force = [along[0] * newtons, along[1] * newtons, along[2] * newtons] as const;
        return [id, { force, point: [position.x, position.y, position.z] as const }];
      }),
    ),
  );
}
