"""Steps the physics of a cell; what hands hold firmly is a part of them for as long as they hold it.

A thing that a weld holds costs six degrees of freedom and six constraints, and the fingers around it two or three,
though none of them moves. So while a grasp is firm, steps are computed with another model of the same scene, the tight
one, in which the thing is fixed to the palm and the fingers to their places. The cell's own model, in which all is free
and the weld is active, stays what everybody else reads and writes: after each step it shows the state of the other.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from skillc_runtime.backends.mujoco import momentum
from skillc_runtime.backends.mujoco.divergence import DivergenceMonitor
from skillc_runtime.backends.mujoco.far_bodies import FarBodies, make_far_bodies
from skillc_runtime.backends.mujoco.mirror import Half, Mirror, Pull
from skillc_runtime.backends.mujoco.model_map import map_models
from skillc_runtime.backends.simulation.arms.whole_mass import WholeMass
from skillc_runtime.backends.simulation.contacts import Contacts
from skillc_runtime.backends.simulation.machine_code import address_of, has_room, row_calling, stop_timers
from skillc_runtime.backends.simulation.model.hold import read_hold
from skillc_runtime.backends.simulation.model.model_builder import build_model
from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.backends.simulation.scene_spec import SceneSpec
from skillc_runtime.backends.simulation.variation.variation import Variation
from skillc_runtime.motion.numerics.compiled import COMPILES
from skillc_runtime.motion.numerics.program import IDLE, Rows, join, row_of
from skillc_runtime.world.state.data_sheet import SheetError


@dataclass(slots=True)
class Physics:
    """The physics of a cell, whose model and data these are; `contacts` are those of the last step."""

    scene: SceneSpec
    variation: Variation
    model: Any
    data: Any
    contacts: Contacts
    tightens: bool = field(init=False)
    """Whether what is held becomes a part of the hand: if there is one hand, and functions are compiled."""
    _holders: dict[str, str] = field(default_factory=dict)
    _mirror: Mirror | None = None
    _pulls: dict[str, Pull] = field(default_factory=dict)
    _is_due: bool = False
    _rows: dict[Half, Rows | None] = field(default_factory=dict)
    """What computes each half of a step of the model that is stepped."""

    monitor: DivergenceMonitor = field(init=False)
    """Watches the model that is stepped."""
    far: FarBodies | None = field(init=False)
    """What the search for contacts leaves out of the model that is stepped."""
    mass: WholeMass = field(init=False)
    """The mass matrix of the model of the cell, in which what is held does not burden an arm."""

    _far_of_cell: FarBodies | None = field(init=False)

    def __post_init__(self) -> None:
        stop_timers()
        self.far = self._far_of_cell = make_far_bodies(self.model, self.data)
        self.monitor, self.mass = DivergenceMonitor(self.model, self.data), WholeMass(self.model, self.data)
        # Of two hands each may grasp or release while the other one holds something; without compiled functions,
        # showing the state of another model costs more than it saves.
        hands = sum(arm.gripper is not None for arm in self.scene.arms)
        self.tightens = COMPILES and address_of("mj_step1") != 0 and hands == 1

    def hold(self, thing: str, gripper: str) -> None:
        """Let a thing be a part of the hand, whose fingers stand still, that a weld holds it in; both are IRIs."""
        if self.tightens and thing not in self._holders and has_room(self.data):
            self._loosen()
            self._holders[thing], self._is_due = gripper, True

    def release(self, thing: str) -> None:
        """Let a thing, and the fingers around it, be free again; nothing happens if it is no part of a hand."""
        if self._holders.pop(thing, None) is not None:
            self._loosen()
            self._is_due = bool(self._holders)

    def prepare(self) -> None:
        """Compute all that follows from the positions in the data of the cell, before the first step."""
        mujoco.mj_forward(self.model, self.data)

    def renew(self) -> None:
        """Take over what was changed in the model or the data of the cell between two steps."""
        if self._mirror is not None:
            self._mirror.rows.renew(self.model, self._mirror.tight_model)
            self._mirror.take_changes(self.data.time)
        if self.far is not None:
            self.far.renew()
        self.compute_places()
        self.monitor.step(self.data.time)

    def compute_places(self) -> None:
        """Compute what follows from positions and speeds: the first part of a step."""
        if self._is_due:
            mujoco.mj_step1(self.model, self.data)
            self._tighten()
        self._run("mj_step1")

    def move(self) -> None:
        """Compute forces and move: the rest of a step, after `compute_places`."""
        if self._is_due:
            self._tighten()
            self.compute_places()
        self._run("mj_step2")

    def find_rows(self, half: Half) -> Rows | None:
        """Return what computes half a step as things are now; None if only Python can."""
        if self._is_due:
            return None
        if half not in self._rows:
            self._rows[half] = self._make_rows(half)
        return self._rows[half] if has_room(self.data if self._mirror is None else self._mirror.tight) else None

    def _make_rows(self, half: Half) -> Rows | None:
        mirror, far = self._mirror, self.far
        rows = row_calling(half, self.model, self.data) if mirror is None else row_of(mirror.halves[half])
        if half == "mj_step2" or far is None:
            return join(rows, self.monitor.rows)
        return join(row_of(far.leave_out), rows, row_of(far.take_in), self.monitor.rows)

    def _run(self, half: Half) -> None:
        far = self.far if half == "mj_step1" else None
        if far is not None:
            far.leave_out(self.data.time)
        self._run_half(half)
        if far is not None:
            far.take_in(self.data.time)

    def _run_half(self, half: Half) -> None:
        if self._mirror is not None and has_room(self._mirror.tight):
            self._mirror.halves[half](self.data.time)
            return
        self._holders.clear()
        self._loosen()
        getattr(mujoco, half)(self.model, self.data)

    def take_changes(self) -> None:
        """Take over where things were put in the data of the cell between two half steps."""
        if self._mirror is not None:
            self._mirror.take_changes(self.data.time)

    def set_friction(self, geom: int, friction: float) -> None:
        """Let a geom, by its number in the model of the cell, have a sliding friction from now on."""
        self.model.geom_friction[geom, 0] = friction
        if self._mirror is not None:
            self._mirror.tight_model.geom_friction[self._mirror.rows.geoms[geom], 0] = friction

    @property
    def taking(self) -> Rows | None:
        """What takes over these places."""
        return IDLE if self._mirror is None else row_of(self._mirror.take_changes)

    def pull_on(self, thing: str) -> Pull | None:
        """Return what computes the force of a hand on a thing that is a part of it; None if it is none."""
        return self._pulls.get(thing)

    def find_bodies(self, bodies: list[int]) -> list[int]:
        """Return the numbers of bodies in the model with which contacts are computed."""
        return bodies if self._mirror is None else self._mirror.rows.bodies[bodies].tolist()

    def _tighten(self) -> None:
        """Go on with a model in which what is held is a part of the hand."""
        names, self._is_due = self.scene.names, False
        try:
            holds = {
                thing: read_hold(self.model, self.data, names[gripper], names[thing])
                for thing, gripper in self._holders.items()
            }
            model = build_model(self.scene, self.variation, self.model.opt.timestep, holds)
            rows = map_models(self.model, model)
        except (ValueError, SheetError):  # something of a gripper needs its fingers, or cannot be told apart
            self.tightens = False
            self._holders.clear()
            return
        data, blocks = mujoco.MjData(model), self._blocks()
        far = make_far_bodies(model, data)
        rows.renew(self.model, model)
        momentum.join(rows, self.model, self.data, model, data, blocks)
        self._mirror = Mirror(rows, self.model, self.data, model, data, list(blocks))
        self._pulls = dict(zip(self._holders, self._mirror.pulls, strict=True))
        self._step_with(model, data, np.argsort(rows.geoms), far)

    def _loosen(self) -> None:
        """Go on with the model of the cell."""
        mirror, self._mirror, self._pulls = self._mirror, None, {}
        if mirror is not None:
            momentum.part(
                mirror.rows, self.model, self.data, mirror.tight_model, mirror.tight, self._blocks(mirror.blocks)
            )
            mujoco.mj_step1(self.model, self.data)
            self._step_with(self.model, self.data, np.arange(self.model.ngeom), self._far_of_cell)

    def _step_with(self, model: Any, data: Any, geoms: NDArray[np.int64], far: FarBodies | None) -> None:
        """Watch what steps use from now on; `geoms` are the numbers (ngeom,) in the cell's model of the geoms there."""
        if far is not None:
            far.renew()
        self.far, self._rows = far, {}
        self.monitor = DivergenceMonitor(model, data)
        self.contacts.read_from(model, data, geoms)
        self.mass.let_be_stepped(model is self.model)

    def _block(self, thing: str) -> int:
        return int(self.model.body(part_name(self.scene.names[thing], "block")).id)

    def _blocks(self, blocks: list[int] | None = None) -> dict[int, int]:
        """Return the bodies of what is held, each with its first degree of freedom in the model of the cell."""
        found = [self._block(thing) for thing in self._holders] if blocks is None else blocks
        return {block: int(self.model.jnt_dofadr[self.model.body_jntadr[block]]) for block in found}
