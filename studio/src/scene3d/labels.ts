// Labels over the picture: text, never HTML, each beside its point; those that would cover a more important one are left out.
import type * as three from "three";

export type LabelKind = "name" | "selected" | "believed" | "force" | "measure";

/** A text at a point in the world; of two that overlap the one with the higher rank is shown. */
export interface Label {
  key: string;
  text: string;
  at: three.Vector3;
  kind: LabelKind;
  rank: number;
}

const HEIGHT = 20;
const WIDTH_OF_CHARACTER = 6.6;
const PADDING = 14;
/** How far above or below its point a label is. */
const GAP = 4;

export interface Box {
  left: number;
  top: number;
  right: number;
  bottom: number;
}

/** Return where the lower middles of labels are in pixels, by key: above their points, or below if there is no room.
 *  Those behind the viewer, outside or covered on both sides are left out; none goes over the edges of a picture of a
 *  width. `reserved` is covered by something else. */
export function placeLabels(
  labels: readonly Label[],
  project: (at: three.Vector3) => { x: number; y: number } | null,
  width: number,
  reserved: readonly Box[] = [],
): Map<string, { x: number; y: number }> {
  const taken = [...reserved];
  const places = new Map<string, { x: number; y: number }>();
  for (const label of [...labels].sort((one, other) => other.rank - one.rank)) {
    const at = project(label.at);
    if (at === null) continue;
    const half = (label.text.length * WIDTH_OF_CHARACTER + PADDING) / 2;
    const x = Math.max(half, Math.min(width - half, at.x));
    const boxes = [at.y - GAP, at.y + GAP + HEIGHT].map((bottom) => ({
      left: x - half,
      right: x + half,
      top: bottom - HEIGHT,
      bottom,
    }));
    const box = boxes.find((one) => !taken.some((each) => overlaps(each, one)));
    if (box === undefined) continue;
    taken.push(box);
    places.set(label.key, { x, y: box.bottom });
  }
  return places;
}

function overlaps(one: Box, other: Box): boolean {
  return one.left < other.right && other.left < one.right && one.top < other.bottom && other.top < one.bottom;
}

/** Shows labels as elements, which are kept from one frame to the next. */
export class LabelLayer {
  private readonly elements = new Map<string, HTMLElement>();

  constructor(private readonly parent: HTMLElement) {}

  show(
    labels: readonly Label[],
    project: (at: three.Vector3) => { x: number; y: number } | null,
    width: number,
    reserved: readonly Box[],
  ): void {
    const places = placeLabels(labels, project, width, reserved);
    const known = new Map(labels.map((each) => [each.key, each]));
    for (const [key, element] of this.elements)
      if (!places.has(key)) {
        element.remove();
        this.elements.delete(key);
      }
    for (const [key, { x, y }] of places) {
      const label = known.get(key);
      if (label === undefined) continue;
      const element = this.elements.get(key) ?? this.add(key);
      if (element.textContent !== label.text) element.textContent = label.text;
      if (element.dataset["kind"] !== label.kind) element.dataset["kind"] = label.kind;
      element.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px) translate(-50%, -100%)`;
    }
  }

  private add(key: string): HTMLElement {
    const element = document.createElement("div");
    element.className = "scene-label";
    this.parent.append(element);
    this.elements.set(key, element);
    return element;
  }
}
