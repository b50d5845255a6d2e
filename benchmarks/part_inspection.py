"""How well images tell which parts are good, and which codes they have: counts against the truth of the simulator.

    python benchmarks/part_inspection.py [SCENES] [--wrist]

Each of 100 scenes has two parts with places, turns, colours of their faces, codes and defects of their own, and light,
place of the camera and noise. One part of ten has no label, and in one scene of five an arm is over the tray. What the
image does not decide is counted apart. With --wrist, the arm looks from above with a camera on its flange instead.
"""

from __future__ import annotations

import sys
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from functools import cache, partial

import msgspec
import numpy as np

from skillc.services.library.files import SHIPPED, find_library
from skillc.services.library.libraries import compile_library
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.cameras.image_camera import ImageCamera
from skillc_runtime.devices.device_map import NoSuchDevice
from skillc_runtime.primitives.look_at import LookAt
from skillc_runtime.primitives.primitive import SkillFailure, Status
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.changes import Change, ClearProperty, SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import SKILLC
from skillc_runtime.world.state.world_state import WorldState

LAB = "http://example.org/lab#"
SCENES = 100
FIXED, ON_WRIST = "inspected.ttl", "wrist_camera.ttl"
OVER_TRAY = (-0.69, 0.5, 0.0, -1.7, 0.0, 2.2, 0.8)
"""Joints in rad at which the hand is over the tray."""


class Judged(msgspec.Struct, frozen=True):
    """A part: its defect and whether it has a label; what was seen, or why that was not decided."""

    defect: str
    labelled: bool
    hidden: bool
    seen: str = ""
    confidence: float = 0.0
    code_is_right: bool = False
    why: str = ""


@cache
def first_state(scene: str) -> WorldState:
    """Return a shipped scene in which parts are inspected."""
    vocabulary = compile_library(find_library(SHIPPED / "sorting")).value.vocabulary
    return load_scene(SHIPPED / "sorting" / scene, vocabulary)


def draw_changes(rng: np.random.Generator) -> tuple[list[Change], dict[str, int | None]]:
    """Return changes of the scene, and the code of each part."""
    changes: list[Change] = []
    for kind in ("Cover", "Flange"):
        colour = " ".join(str(each) for each in rng.integers(60, 230, 3))
        changes.append(SetProperty(f"{LAB}{kind}", SKILLC + "faceColour", colour))
    codes: dict[str, int | None] = {}
    for part, side in (("Part-A", -1), ("Part-B", 1)):
        code = int(rng.integers(100, 300))
        codes[part] = None if rng.random() < 0.1 else code
        facts = {
            "labelCode": codes[part],
            "turnRange": 3.1,
            "atX": rng.uniform(-0.06, 0.06),
            "atY": side * rng.uniform(0.06, 0.1),
        }
        for name, value in facts.items():
            thing, term = LAB + part, SKILLC + name
            changes.append(ClearProperty(thing, term) if value is None else SetProperty(thing, term, value))
    return changes, codes


def stand_above(cell: SimulatedCell, part: str) -> None:
    """Let the arm take its camera to where it sees all of a part, by IRI."""
    look = LookAt(cell, arm=f"{LAB}Arm-1", thing=part, pace=0.5)
    look.start()
    while look.tick() is Status.RUNNING:
        cell.advance(0.01)


def inspect_scene(seed: int, scene: str) -> list[Judged]:
    """Return what was seen of each part of a scene."""
    rng = np.random.default_rng(seed)
    changes, codes = draw_changes(rng)
    cell = SimulatedCell(WorldModel(first_state(scene).with_changes(changes)), seed)
    camera = cell.camera()
    assert isinstance(camera, ImageCamera), "OpenCV or a GL library is missing"
    hidden = seed % 5 == 0 and scene == FIXED
    if hidden:
        cell.data.qpos[:7] = OVER_TRAY + rng.uniform(-0.2, 0.2, 7)
        cell.refresh()
    found = []
    for part, code in codes.items():
        face = camera.true_faces.get(LAB + part)
        what = Judged(face.defect if face else "", code is not None, hidden)
        try:
            if scene == ON_WRIST:
                stand_above(cell, LAB + part)
            seen = camera.classify(LAB + part)
        except (NoSuchDevice, SkillFailure) as error:
            found.append(msgspec.structs.replace(what, why=str(error).partition(": ")[2] or str(error)))
            continue
        grade = "good" if seen.good else "scrap"
        right = seen.code == code
        found.append(msgspec.structs.replace(what, seen=grade, confidence=seen.confidence, code_is_right=right))
    return found


def main(scenes: int, scene: str) -> None:
    """Print confusion counts, codes that were read, and why images did not decide."""
    judged: list[Judged] = []
    with ProcessPoolExecutor(2) as pool:
        for number, each in enumerate(pool.map(partial(inspect_scene, scene=scene), range(1000, 1000 + scenes)), 1):
            judged += each
            print(number, *each, file=sys.stderr)
    print(f"{scenes} scenes, {len(judged)} parts")
    for defect in sorted({each.defect for each in judged}):
        of = [each for each in judged if each.defect == defect]
        seen = Counter(each.seen or "not decided" for each in of)
        print(f"{defect or 'no defect'}: {len(of)}, " + ", ".join(f"{seen[n]} {n}" for n in sorted(seen)))
    decided = [each for each in judged if each.seen]
    wrong = sum((each.seen == "scrap") != bool(each.defect) for each in decided)
    print(
        f"decided {len(decided)}, {wrong} wrong; mean confidence {np.mean([each.confidence for each in decided]):.4f}"
    )
    print(f"codes read {len(decided)}, {sum(not each.code_is_right for each in decided)} wrong")
    in_view = [each for each in judged if each.labelled and not each.hidden]
    left = sum(not each.seen for each in in_view)
    print(f"with a label and no arm over the tray: {len(in_view)}, {left} not decided")
    for why, count in Counter(each.why for each in judged if each.why).most_common():
        print(f"{count} x {why}")


if __name__ == "__main__":
    numbers = [each for each in sys.argv[1:] if each != "--wrist"]
    main(int(numbers[0]) if numbers else SCENES, ON_WRIST if "--wrist" in sys.argv else FIXED)
