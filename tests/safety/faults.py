"""Primitives that break where a test wants them to, in cells of the shipped scenes."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from importlib import import_module
from pkgutil import walk_packages
from typing import ClassVar

import numpy as np

from simulation.cells import LAB, begin, world
from skillc_model import tree
from skillc_model.conditions import Compare, Individual, Literal, PropertyOf
from skillc_runtime import primitives
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.devices.cell import Cell
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, ExecuteBody, PreparedTask
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.motion.pose import Pose
from skillc_runtime.primitives.arm_motion import ArmMotion
from skillc_runtime.primitives.compliance import ReleaseAxis
from skillc_runtime.primitives.overlay import AddedMotion
from skillc_runtime.primitives.primitive import Primitive, SkillFailure, Status
from skillc_runtime.recording.events import Event, NodeEnded, Note, TaskEnded
from skillc_runtime.world.space.frames import placement_changes, pose
from skillc_runtime.world.space.wrist_camera import find_wrist_camera
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, SetProperty
from skillc_runtime.world.state.terms import (
    ARM_DEVICE,
    BUTTON,
    CAMERA,
    CONTACT,
    FRAME_ID,
    HAS_SHEET,
    INPUT_POINT,
    MOBILE_ROBOT,
    OUTPUT_POINT,
    RPARTS,
    SKILLC,
    SURFACE,
    TOOL,
    WEIGHT,
)
from skillc_runtime.world.state.world_state import WorldState
from tree.library import Library, call, par, with_

EYE, LAMP, GATE = LAB + "Overhead-1", LAB + "Lamp-1", LAB + "Gate-1"
GRIPPER_EFFECTOR, WORKSTATION = RPARTS + "GripperEffector", SKILLC + "Workstation"
SCENES = ("iiwa_table", "ur5e_whiteboard", "ur5e_button", "panda_peg", "iiwa_guiding", "iiwa_wrist_camera")

ABSTRACT = {Primitive, ArmMotion, AddedMotion}
TICKS = 3
"""Ticks before a break or a halt."""


def wanted(kind: type[Primitive]) -> set[str]:
    """Return the names of a primitive's parameters."""
    parameters = inspect.signature(kind).parameters.values()
    return {each.name for each in parameters if each.kind is each.KEYWORD_ONLY}


def _classes() -> dict[str, type[Primitive]]:
    modules = [import_module(found.name) for found in walk_packages(primitives.__path__, f"{primitives.__name__}.")]
    found = {cls for module in modules for _, cls in inspect.getmembers(module, inspect.isclass)}
    return {cls.__name__: cls for cls in found if issubclass(cls, Primitive) and cls not in ABSTRACT}


CLASSES = _classes()


KINDS = {
    "arm": ARM_DEVICE,
    "gripper": GRIPPER_EFFECTOR,
    "object": TOOL,
    "tool": TOOL,
    "surface": SURFACE,
    "robot": MOBILE_ROBOT,
    "place": WORKSTATION,
    "to": WORKSTATION,
    "button": BUTTON,
    "socket": CONTACT + "Socket",
    "pose": CONTACT + "TaughtPose",
    "camera": CAMERA,
    "output": OUTPUT_POINT,
    "point": INPUT_POINT,
    "thing": SURFACE,
}
"""Of which classes the things are that parameters of these names stand for; a camera on a flange looks at `thing`."""

MOTION = {"posture": "home", "pace": 0.5, "speed": 0.2, "resistance": 15.0, "blend": 0.01, "settle": 5.0}
WAITING = {"into": None, "patience": 5.0, "travel": 0.5}
PRESSING = {
    "stiffness": 0.0,
    "force": 10.0,
    "opening": 0.02,
    "approach": 0.05,
    "depth": 0.02,
    "still": 1.5,
    "over": 5.0,
    "tolerance": 0.05,
}
SWINGING = {"radius": 0.01, "tilt": 0.5, "rate": 1.0, "amplitude": 0.01, "pitch": 0.001}
ASKING = {"text": "Is it empty?", "choices": "yes | no", "default": None, "limit": 60.0}
INSPECTED = {"part": EYE, "at": EYE, "rub": 10.0}
WIRED = {"level": 1.0, "least": 1.0, "most": 1.0}
FIGURE = {"width": 0.01, "height": 0.01, "across_rate": 2.0, "phase": 0.0}


@cache
def watched(scene: str) -> WorldState:
    """Return the world of a shipped scene with a camera over its tool, an output and an input."""
    state = world(scene)
    tool = pose(state, min(state.instances(TOOL))).position if state.instances(TOOL) else np.zeros(3)
    over = Pose.of((float(tool[0]), float(tool[1]), float(tool[2]) + 1.0), (0.0, 1.0, 0.0, 0.0))
    sheet = AddRelation(EYE, HAS_SHEET, SKILLC + "depth-camera-sheet")
    wired = [AddIndividual(LAMP, (OUTPUT_POINT,)), AddIndividual(GATE, (INPUT_POINT,))]
    seen = [AddIndividual(EYE, (CAMERA,)), sheet, SetProperty(EYE, FRAME_ID, "eye"), *placement_changes(EYE, over)]
    return state.with_changes([*wired, *seen])


def things(scene: str) -> dict[str, str]:
    """Return what parameters that stand for things may be in a scene, by their names."""
    state = watched(scene)
    found = {name: sorted(state.instances(kind)) for name, kind in KINDS.items()}
    if find_wrist_camera(state, found["arm"][0]) is None:
        del found["thing"]
    return {name: individuals[0] for name, individuals in found.items() if individuals}


def scene_for(kind: type[Primitive], number: int) -> str:
    """Return a scene that has everything a primitive needs; they take turns with `number`."""
    turns = [SCENES[(number + more) % len(SCENES)] for more in range(len(SCENES))]
    return next(scene for scene in turns if wanted(kind) & set(KINDS) <= set(things(scene)))


def arguments(scene: str, cell: Cell) -> dict[str, object]:
    """Return what the parameters of primitives may be in a scene, by their names."""
    tool = cell.arm(things(scene)["arm"]).motion.stopping_pose()
    raised = Pose(tool.position + np.array([0.0, 0.0, 0.05]), tool.rotation)
    beside = Pose(tool.position + np.array([0.02, 0.0, 0.025]), tool.rotation)
    poses = {"via": beside, "target": raised, "path": [raised, tool], "at": tool}
    directions = {"along": -tool.rotation[:, 2], "plane": tool.rotation[:, 0]}
    return {
        **things(scene),
        **MOTION,
        **WAITING,
        **PRESSING,
        **SWINGING,
        **FIGURE,
        **ASKING,
        **WIRED,
        **INSPECTED,
        **poses,
        **directions,
    }


class Pushing(Primitive):
    """Pushes with 10 N into the air until its scope ends."""

    def __init__(self, cell: Cell, *, arm: str, along: np.ndarray) -> None:
        super().__init__(cell)
        self.arm, self._along = cell.arm(arm), along

    def start(self) -> None:
        self.arm.compliance.push(self._along, 10.0)

    def tick(self) -> Status:
        return Status.SUCCESS

    def release(self) -> None:
        self.arm.compliance.push_off()


class Breaking(Primitive):
    """Does what the primitive `SCENE CLASS` does; of `SCENE CLASS PHASE` it breaks the phase, after doing its work.

    Phases: start, tick, halt, release. One that is to break later does not end by itself. It breaks with an exception,
    or, where its name has an odd number of letters, with `sys.exit`.
    """

    has_begun: ClassVar[bool] = False
    """Whether one that is to break has started: ticks count from then on."""

    def __init__(self, cell: Cell, *, name: str) -> None:
        super().__init__(cell)
        scene, kind, *phase = name.split()
        cls = {"Pushing": Pushing, **CLASSES}[kind]
        known = arguments(scene, cell)
        assert wanted(cls) <= set(known), f"say in `arguments` what {kind} may be called with"
        self._inner = cls(cell, **{name: known[name] for name in wanted(cls)})
        self._phase, self._ticks = phase[0] if phase else "", 0
        self._error = (RuntimeError, SystemExit)[len(kind) % 2]

    def start(self) -> None:
        Breaking.has_begun = Breaking.has_begun or bool(self._phase)
        with suppress(SkillFailure):
            begin(self._inner)
        self._break("start")

    def tick(self) -> Status:
        self._ticks += 1
        if self._phase in ("", "release"):
            return self._inner.tick()
        if self._ticks > TICKS:
            self._break("tick")
        return Status.RUNNING

    def halt(self, reason: str) -> None:
        self._do("halt", lambda: self._inner.halt(reason))

    def release(self) -> None:
        self._do("release", self._inner.release)

    def _do(self, phase: str, work: Callable[[], None]) -> None:
        """Do the work, or break instead of doing it."""
        self._break(phase)
        work()

    def _break(self, phase: str) -> None:
        if self._phase == phase:
            raise self._error(f"broke at {phase}")


def run(cell: SimulatedCell, scene: str, kind: str, phase: str) -> tuple[list[Event], str]:
    """Run a primitive that breaks while the arm yields, pushes and circles; return what was told, and the status.

    Where it breaks neither at its start nor in a tick, the run is interrupted.
    """
    told: list[Event] = []
    ticks = 0

    def interrupted() -> bool:
        nonlocal ticks
        ticks += Breaking.has_begun
        return phase in ("halt", "release") and ticks > TICKS

    Breaking.has_begun = False
    execution = execute_task(
        prepared(cell, scene, f"{scene} {kind} {phase}"), LIBRARY, cell, (told.append,), interrupted=interrupted
    )
    return told, execution.status


def prepared(cell: SimulatedCell, scene: str, name: str) -> PreparedTask:
    """Return what runs a primitive that may break while the arm yields, pushes and circles."""
    body = _body(scene, name)
    return PreparedTask(Assignment("safety", cell.world.snapshot(), ExecuteBody(body)), body, None)


def reaching(cell: SimulatedCell, scene: str, name: str) -> PreparedTask:
    """Return the same for a goal that is not reached by it, so that a new plan is wanted."""
    body, goal = (
        _body(scene, name),
        Compare(PropertyOf(Individual(things(scene)["object"]), WEIGHT), "==", Literal(9.0)),
    )
    return PreparedTask(Assignment("safety", cell.world.snapshot(), AchieveGoal(goal)), body, None)


def _body(scene: str, name: str) -> tree.Node:
    circling = call("Act", name=f"{scene} OverlayCircle")
    broken: tree.Node = call("Act", name=name)
    if name.endswith("release"):
        broken = with_(name, circling)
    return with_(f"{scene} {ReleaseAxis.__name__}", with_(f"{scene} {Pushing.__name__}", par("all", circling, broken)))


LIBRARY = Library(f"{__name__}:{Breaking.__name__}").build()


def reasons(told: list[Event]) -> str:
    """Return everything that the trace says about why."""
    failures = [event.failure for event in told if isinstance(event, NodeEnded | TaskEnded) and event.failure]
    return "\n".join([*(f.message for f in failures), *(event.message for event in told if isinstance(event, Note))])
