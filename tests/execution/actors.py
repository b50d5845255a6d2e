"""A kinematic cell with one arm in which scripted skills use the real primitives, and what must be true after a run."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import ClassVar

import numpy as np
from msgspec import structs

from safety.faults import CLASSES, Pushing, arguments, wanted
from simulation.cells import begin, vocabulary
from skillc_ontology import catalogue
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.devices.cell import Cell
from skillc_runtime.primitives.primitive import Primitive, SkillFailure, Status
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.changes import AddIndividual, SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.world_state import WorldState
from tree.library import DEVICE, DEVICES, FLAG, FLAGS, ON, VOCABULARY
from tree.stage import Script

SCENE = "iiwa_table"
KINDS = ("MoveLinear", "MoveJoints", "ReleaseAxis", "Pushing", "OverlayCircle", "ThreeFingerGripper")
"""The primitives that scripted skills use, in turn."""

CREEP_RAD = 0.005
"""How far a joint that is held may go on in 0.3 s: the compliant arm follows its reference, which rests, with a lag."""


@cache
def known_world() -> WorldState:
    """Return the scene with the flags and devices of a stage."""
    mixed = vocabulary()
    mixed = structs.replace(
        mixed,
        prefixes={**mixed.prefixes, **VOCABULARY.prefixes},
        classes={**mixed.classes, **VOCABULARY.classes},
        properties={**mixed.properties, **VOCABULARY.properties},
        functions={**mixed.functions, **VOCABULARY.functions},
    )
    flags = [change for iri in FLAGS for change in (AddIndividual(iri, (FLAG,)), SetProperty(iri, ON, True))]
    devices = [AddIndividual(iri, (DEVICE,)) for iri in DEVICES]
    return load_scene(catalogue.scene_path(SCENE), mixed).with_changes([*flags, *devices])


@dataclass
class Told:
    """What a primitive was told, in order."""

    name: str
    calls: list[str]


class Acting(Primitive):
    """Does what a primitive does, for as many ticks as its script says, and ends as it says."""

    scripts: ClassVar[dict[str, list[Script]]] = {}
    told: ClassVar[list[Told]] = []
    starts: ClassVar[dict[str, int]] = {}

    @classmethod
    def prepare(cls, scripts: dict[str, list[Script]]) -> None:
        """Forget what was, for a run with these scripts."""
        cls.scripts, cls.told, cls.starts = scripts, [], {}

    def __init__(self, cell: Cell, *, name: str, **rest: object) -> None:
        super().__init__(cell)
        number = self.starts.get(name, 0)
        self.starts[name] = number + 1
        self.script = self.scripts[name][number % len(self.scripts[name])]
        kind = KINDS[int(name[1:]) % len(KINDS)]
        cls = Pushing if kind == "Pushing" else CLASSES[kind]
        known = arguments(SCENE, cell)
        self._inner: Primitive = cls(cell, **{each: known[each] for each in wanted(cls)})
        self._calls: list[str] = []
        self._left = 10 * self.script.ticks
        self.told.append(Told(name, self._calls))

    def start(self) -> None:
        self._calls.append("start")
        if self.script.ending == "refuse":
            raise SkillFailure("it refuses")
        begin(self._inner)
        if self.script.ending == "crash at start":
            raise RuntimeError("it broke")

    def tick(self) -> Status:
        self._left -= 1
        status = self._inner.tick()
        if self._left > 0 and status is Status.RUNNING:
            return Status.RUNNING
        match self.script.ending:
            case "fail":
                raise SkillFailure("it failed")
            case "exit":
                raise SystemExit(0)
            case "crash":
                raise RuntimeError("it broke")
        if status is Status.SUCCESS:
            self._calls.append("success")
        return status

    def halt(self, reason: str) -> None:
        self._calls.append("halt")
        self._inner.halt(reason)

    def pause(self) -> None:
        self._calls.append("pause")
        self._inner.pause()

    def withdraw(self) -> None:
        self._calls.append("withdraw")
        self._inner.withdraw()

    def approach(self) -> bool:
        self._calls.append("approach")
        return self._inner.approach()

    def resume(self) -> None:
        self._calls.append("resume")
        self._inner.resume()

    def release(self) -> None:
        self._calls.append("release")
        self._inner.release()


def cell() -> KinematicCell:
    """Return the cell at its start."""
    return KinematicCell(WorldModel(known_world()))


def postures(cell: KinematicCell | SimulatedCell) -> np.ndarray:
    """Return the joint positions of all arms in rad, one after the other."""
    return np.concatenate([cell.arm(arm.individual).measured.q for arm in cell.scene.arms])


def check_rest(cell: KinematicCell | SimulatedCell) -> None:
    """Check that nothing pushes, yields or moves, and that nothing begins to move by itself."""
    assert cell.is_at_rest()
    for arm in cell.scene.arms:
        compliance = cell.arm(arm.individual).compliance
        assert (compliance.commanded_stiffness > 0).all() and (abs(compliance.commanded_wrench) < 0.1).all()
    before = postures(cell)
    cell.advance(0.3)
    assert cell.is_at_rest() and abs(postures(cell) - before).max() < CREEP_RAD
