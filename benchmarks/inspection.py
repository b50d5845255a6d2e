"""How well images tell which cells of a table are dirty: precision and recall against the truth of the simulator.

    python benchmarks/inspection.py [SCENES] [--wrist]

Each of 100 scenes has dirt that was rubbed off in random places, light, place of the camera, noise and start posture of
the arm of its own. A cell of 1 cm is really dirty if its mean amount of dirt is at least 0.2. Cells that the camera
does not see are counted apart. With --wrist, the arm looks from above with a camera on its flange.
"""

from __future__ import annotations

import sys
from concurrent.futures import ProcessPoolExecutor
from functools import partial

import numpy as np

from skillc_dsl.source import Source
from skillc_ontology import catalogue
from skillc_rdf.vocabulary.load import load
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.cameras.image_camera import PIXELS_PER_CELL, ImageCamera
from skillc_runtime.devices.device_map import NoSuchDevice
from skillc_runtime.motion.dirt_map import CLEAN, DIRTY, UNSEEN
from skillc_runtime.motion.pose import Array
from skillc_runtime.primitives.look_at import LookAt
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.scene.load import load_scene
from skillc_runtime.vision.cell_map import DIRTY_AMOUNT
from skillc_runtime.world.state.model import WorldModel

TABLE, ARM = "http://example.org/lab#Table-1", "http://example.org/lab#Iiwa-1"
SCENES = 100
FIXED, ON_WRIST = "iiwa_watched", "iiwa_wrist_camera"


def draw_dose(shape: tuple[int, int], rng: np.random.Generator) -> Array:
    """Return contact times in s (rows, columns), in cells of 5 mm: strokes of a tool, some too short to clean."""
    dose = np.zeros(shape)
    y, x = np.mgrid[: shape[0], : shape[1]]
    for _ in range(rng.integers(1, 9)):
        turn, middle = rng.uniform(0, np.pi), rng.uniform(0, 1, 2) * shape
        across = np.abs(np.cos(turn) * (y - middle[0]) + np.sin(turn) * (x - middle[1]))
        along = np.abs(-np.sin(turn) * (y - middle[0]) + np.cos(turn) * (x - middle[1]))
        under = (across < rng.uniform(5, 10)) & (along < rng.uniform(10, 60))
        dose += under * rng.choice([0.3, 3.0, 6.0], p=[0.15, 0.35, 0.5])
    return dose


def stand_above(cell: SimulatedCell) -> None:
    """Let the arm take its camera to where it sees all of the table."""
    look = LookAt(cell, arm=ARM, thing=TABLE, pace=0.5)
    look.start()
    while look.tick() is Status.RUNNING:
        cell.advance(0.01)


def inspect_scene(seed: int, scene: str) -> tuple[int, int, int, float, str]:
    """Return how many cells were rightly and wrongly dirty, and wrongly clean, the share seen, and what went wrong."""
    state = load_scene(catalogue.scene_path(scene), shipped_vocabulary())
    cell = SimulatedCell(WorldModel(state), seed)
    camera = cell.camera()
    assert isinstance(camera, ImageCamera), "OpenCV or a GL library is missing"
    dose = cell.coverage[TABLE].dose
    dose[:] = draw_dose(dose.shape, np.random.default_rng(seed))
    if scene == ON_WRIST:
        stand_above(cell)
    fine = camera.true_amounts(TABLE)
    rows, columns = (each // PIXELS_PER_CELL for each in fine.shape)
    dirty = fine.reshape(rows, PIXELS_PER_CELL, columns, PIXELS_PER_CELL).mean(axis=(1, 3)) >= DIRTY_AMOUNT
    try:
        seen = camera.look(TABLE)
    except NoSuchDevice as error:
        return 0, 0, 0, 0.0, str(error)
    found, missed = seen.state == DIRTY, (seen.state == CLEAN) & dirty
    seen_share = float((seen.state != UNSEEN).mean())
    return int((found & dirty).sum()), int((found & ~dirty).sum()), int(missed.sum()), seen_share, ""


def shipped_vocabulary() -> Vocabulary:
    """Return the shipped vocabulary."""
    return load([Source(path, text) for path, text in catalogue.vocabulary_files()]).value


def main(scenes: int, scene: str) -> None:
    """Print precision and recall over all cells, and the quartiles over the scenes."""
    with ProcessPoolExecutor(2) as pool:
        results = []
        for each in pool.map(partial(inspect_scene, scene=scene), range(1000, 1000 + scenes)):
            results.append(each)
            print(len(results), *each, file=sys.stderr)
    right, false, missed = (np.array([each[number] for each in results]) for number in range(3))
    seen = np.array([each[3] for each in results])
    lost = [each[4] for each in results if each[4]]
    print(f"{scenes} scenes, {right.sum() + missed.sum()} dirty cells that were seen, {len(lost)} images not judged")
    print(f"precision {100 * right.sum() / (right.sum() + false.sum()):.2f} %")
    print(f"recall    {100 * right.sum() / (right.sum() + missed.sum()):.2f} %")
    some = right + missed > 20
    for name, wrong in (("precision", false), ("recall", missed)):
        shares = 100 * right[some] / (right + wrong)[some]
        low, middle = np.percentile(shares, 5), np.median(shares)
        print(f"{name} of a scene: least {shares.min():.1f} %, 5 % of them below {low:.1f} %, median {middle:.1f} %")
    print(f"seen: least {100 * seen.min():.0f} %, median {100 * np.median(seen):.0f} % of the cells")
    for why in lost:
        print(why)


if __name__ == "__main__":
    numbers = [each for each in sys.argv[1:] if each != "--wrist"]
    main(int(numbers[0]) if numbers else SCENES, ON_WRIST if "--wrist" in sys.argv else FIXED)
