"""The state shared by all nodes of a tree: time and world state of this tick, the cell, the library, the listener."""

from __future__ import annotations

import math
from collections.abc import Sequence
from heapq import heappop, heappush

from msgspec.structs import replace

from skillc_dsl.position import Position
from skillc_model.skills import SkillLibrary
from skillc_runtime.devices.cell import Cell
from skillc_runtime.devices.prompts import Prompt
from skillc_runtime.execution.success_facts import BrokenCall
from skillc_runtime.execution.tree.computations import Computations
from skillc_runtime.execution.tree.gate import Gate
from skillc_runtime.execution.tree.locks import DeviceLocks
from skillc_runtime.execution.tree.run_cell import RunCell
from skillc_runtime.primitives.planned_postures import PlannedPosture, PlannedPostures
from skillc_runtime.primitives.primitive import Primitive
from skillc_runtime.recording.events import Listener, Note
from skillc_runtime.recording.run_spec import AS_USUAL, RunSpec
from skillc_runtime.world.state.changes import Change
from skillc_runtime.world.state.python_calls import foreign_code
from skillc_runtime.world.state.world_state import WorldState

EPSILON_S = 1e-4
"""What is due so much later than now is due now: times are sums of ticks, whose errors add up over hours.

It is far below the period of a tick and of control.
"""


class TreeContext:
    """The mutable state that the nodes of a tree share.

    `state` is the snapshot of the world for this tick; `now` is the run's own time in s, which stops while paused;
    `time` is the cell's clock in s. `emit` is None without listeners; then no events are created. `gate` holds
    calls back where the run pauses; None if it never does. Primitives see the cell as `run_cell`; `active` are those
    that a pause concerns, `computations` what they compute. `spec` has the settings of the run. `broken_calls` are
    those that did not succeed up to now. `planned_postures` are those of the plan that the tree runs. `happenings`
    counts the nodes that have started or ended.
    """

    __slots__ = (
        "_due",
        "_own_offset",
        "_snapshot",
        "_stopped",
        "active",
        "broken_calls",
        "cell",
        "computations",
        "emit",
        "gate",
        "happenings",
        "last_id",
        "library",
        "locks",
        "now",
        "planned_postures",
        "run_cell",
        "spec",
        "state",
        "time",
    )

    def __init__(
        self,
        library: SkillLibrary,
        cell: Cell,
        emit: Listener | None,
        locks: DeviceLocks,
        ids: int = 0,
        gate: Gate | None = None,
        spec: RunSpec = AS_USUAL,
        postures: Sequence[PlannedPosture] = (),
    ) -> None:
        self.library = library
        self.cell = cell
        self.emit = emit
        self.locks = locks
        self.gate = gate
        self.spec = spec
        self.run_cell = RunCell(cell, spec.speed)
        self.active, self.computations = ActivePrimitives(), Computations()
        self.broken_calls: list[BrokenCall] = []
        self.planned_postures = PlannedPostures(postures, self._tell_of)
        self._stopped, self._own_offset = False, 0.0
        self.time = self.now = 0.0
        self.happenings = 0
        self._due: list[float] = []
        self.state: WorldState
        self.last_id = ids
        self._snapshot = cell.world.snapshot
        self.begin_tick()

    def next_id(self) -> int:
        """Return a number that no other node of the run has."""
        self.last_id += 1
        return self.last_id

    def find_step_end(self) -> float:
        """Return by when what starts now must have ended, in the run's own time in s; infinite without a limit."""
        limit_s = self.spec.step_deadline_s
        if limit_s is None:
            return math.inf
        self.expect(self.now + limit_s)
        return self.now + limit_s - EPSILON_S

    def expect(self, at: float) -> None:
        """Say that something is due at a time, in the run's own time in s."""
        while self._due and self.is_due(self._due[0]):
            heappop(self._due)
        heappush(self._due, at)

    def is_due(self, at: float) -> bool:
        """Whether the time has come, in the run's own time in s."""
        return self.now >= at - EPSILON_S

    def find_next_due(self) -> float:
        """Return how long, in s, nothing will be due; infinite if nothing that runs waits for a time."""
        while self._due and self.is_due(self._due[0]):
            heappop(self._due)
        return self._due[0] - self.now if self._due else math.inf

    def begin_tick(self) -> None:
        """Read the clock and take the newest snapshot."""
        self.time = now = self.cell.now
        if not self._stopped:
            self.now = self.run_cell.now = now - self._own_offset
        self.state = self._snapshot()

    def stop_own_time(self) -> None:
        """Let the run's own time stand still from this tick on."""
        self._stopped = True

    def resume_own_time(self) -> None:
        """Let the run's own time go on from this tick on."""
        self._stopped, self._own_offset = False, self.time - self.now

    def refresh_state(self) -> None:
        """Take the newest snapshot, after a write to the world."""
        self.state = self._snapshot()

    def write_assumed(self, changes: Sequence[Change], origin: str) -> None:
        """Write changes as assumptions in one transaction and refresh `state`. Raises WorldError if it is refused."""
        self.cell.world.commit(changes, origin, "assumed")
        self.refresh_state()

    def _tell_of(self, individual: str, what: str) -> None:
        self.note(f"{self.state.vocabulary.short(individual)} {what}")

    def note(self, message: str, node: int = 0, source: Position | None = None) -> None:
        """Emit a note for users, which has no effect on the run."""
        if self.emit is not None:
            self.emit(Note(time=self.time, message=message, node=node, source=source))


class ActivePrimitives:
    """The active primitives of a run, in the order in which they were started."""

    def __init__(self) -> None:
        self._started: tuple[Primitive, ...] = ()
        self._nodes: dict[Primitive, int] = {}

    @property
    def prompts(self) -> tuple[Prompt, ...]:
        """What they ask operators, with the numbers of their nodes."""
        found: tuple[Prompt, ...] = ()
        for each in self._started:
            if each.prompt is not None:
                found = (*found, replace(each.prompt, id=self._nodes[each]))
        return found

    @property
    def only_ask(self) -> bool:
        """Whether all that goes on is that operators are asked."""
        return bool(self._started) and all(each.prompt is not None for each in self._started)

    def answer(self, node: int, choice: str) -> None:
        """Give the primitive of a node what an operator has chosen."""
        for primitive in self._started:
            if self._nodes[primitive] == node:
                with foreign_code:
                    primitive.answer(choice)

    @property
    def is_pressing(self) -> bool:
        """Whether one of them presses a tool on something."""
        with foreign_code:
            return any(primitive.is_pressing for primitive in self._started)

    def add(self, primitive: Primitive, node: int) -> None:
        """Add a primitive that was started by the node with this number."""
        self._started = (*self._started, primitive)
        self._nodes[primitive] = node

    def discard(self, primitive: Primitive) -> None:
        """Remove a primitive, if it is there, that has ended or was released."""
        self._started = tuple(each for each in self._started if each is not primitive)
        self._nodes.pop(primitive, None)

    def pause(self) -> None:
        """Pause all, the last started first."""
        for primitive in reversed(self._started):
            with foreign_code:
                primitive.pause()

    def withdraw(self) -> None:
        """Withdraw all, the last started first."""
        for primitive in reversed(self._started):
            with foreign_code:
                primitive.withdraw()

    def approach(self) -> Primitive | None:
        """Let each approach once those started before it have; return the first that has not yet, None if all have."""
        with foreign_code:
            return next((primitive for primitive in self._started if not primitive.approach()), None)

    def resume(self) -> None:
        """Resume all, in the order in which they were started."""
        for primitive in self._started:
            with foreign_code:
                primitive.resume()
