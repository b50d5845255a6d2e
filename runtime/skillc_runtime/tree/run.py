"""A run: a body, grounded in a cell and its world, from the first tick to the last."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from skillc_compiler.library import tree
from skillc_compiler.library.skills import SkillLibrary
from skillc_runtime.plans.failures import Failures
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.robots.cell import Cell
from skillc_runtime.robots.contradictions import DeviceWatch
from skillc_runtime.robots.watchdog import Silence
from skillc_runtime.trace.events import Listener, Paused, Resumed
from skillc_runtime.trace.failure import Failure
from skillc_runtime.trace.listeners import Listeners
from skillc_runtime.trace.outcome import Outcome
from skillc_runtime.trace.world import world_changed
from skillc_runtime.tree.build import build
from skillc_runtime.tree.call import CallNode
from skillc_runtime.tree.context import Context
from skillc_runtime.tree.enclosing import Enclosing
from skillc_runtime.tree.errors import told
from skillc_runtime.tree.locks import Locks
from skillc_runtime.tree.node import FAILURE, RUNNING, Node
from skillc_runtime.tree.outcome import outcome
from skillc_runtime.tree.strand import Strand
from skillc_runtime.tree.undo import Undo
from skillc_runtime.verifying import Claim
from skillc_runtime.world.state.model import ChangeEvent

_ALIVE = (RUNNING, Status.IDLE)


class Run:
    """Runs a body of a task: its own, that of a plan, or a single call.

    `status` is IDLE before the first tick, RUNNING, and at the end SUCCESS, FAILURE or HALTED; `failure` says why.
    What scoped skills set up outside any `with` is undone when the run ends. `problems` are those of the listeners.
    """

    def __init__(
        self,
        body: tree.Node,
        library: SkillLibrary,
        cell: Cell,
        listeners: Sequence[Listener] = (),
        locks: Locks | None = None,
        nodes_before: int = 0,
        failures: Failures | None = None,
    ) -> None:
        """Ground the body; nothing starts.

        Runs on the same devices share `locks`; runs that are told of together number their nodes one after the other.
        The calls of the body take nothing that can only fail again, as `failures` knows, and note there what fails.
        """
        self._listeners = Listeners(listeners)
        self._context = Context(library, cell, self._listeners if listeners else None, locks or Locks(), nodes_before)
        self._undo = Undo()
        self._unlisten = cell.world.listen(self._tell_world) if listeners else None
        self._root = build(body, self._context, Enclosing(self._undo, failures=failures))
        self._strand = Strand(self._root)
        self._paused_at: float | None = None
        self._devices = DeviceWatch(cell)
        self.status = Status.IDLE
        self.failure: Failure | None = None

    @property
    def paused(self) -> bool:
        """Whether the run holds still."""
        return self._paused_at is not None

    @property
    def last_node(self) -> int:
        """The number of the last node."""
        return self._context.last_id

    @property
    def outcome(self) -> Outcome:
        """The tree with what became of each node until now."""
        return outcome(self._root)

    @property
    def claims(self) -> tuple[Claim, ...]:
        """The posts of the outermost calls that succeeded."""
        return tuple(_claims(self._root))

    @property
    def problems(self) -> tuple[str, ...]:
        """What went wrong with those who listened."""
        return tuple(self._listeners.problems)

    def tick(self) -> Status:
        """Take the time and a snapshot of the world, go on for one tick, return the status; idle while paused."""
        if self.status not in _ALIVE:
            return self.status
        if self._paused_at is not None:
            return self._still_there()
        try:
            self._context.begin_tick()
            self._beat()
            contradiction = self._contradiction()
            status = self._strand.pulse() if self.status is RUNNING else self._start()
            running = status is RUNNING or self._strand.climb(status) is RUNNING
            if contradiction is not None and self._root.status is not FAILURE:
                return self._refuted(contradiction)
            if running:
                return RUNNING
        except Exception as error:  # noqa: BLE001  the task's boundary: it reports, halts and ends
            self.abort(error)
            return self.status
        return self._ended(self._root.status, self._root.failure)

    def halt(self, reason: str) -> None:
        """Stop everything that runs, undo what must be undone, and end; a run that has ended stays as it is."""
        if self.status in _ALIVE:
            self._context.begin_tick()
            self._root.halt(reason)
            self._ended(Status.HALTED, Failure(kind="halted", message=reason, source=self._root.source))

    def abort(self, error: Exception) -> None:
        """Fail because of an error, of the cell say: halt everything that runs, undo what must be undone, and end."""
        if self.status in (Status.IDLE, RUNNING):
            message = told(error)
            self._root.halt(message)
            self._ended(Status.FAILURE, Failure(kind="error", message=message, source=self._root.source))

    def look_again(self) -> None:
        """After the end: look whether a device contradicts the world model; a success is none then."""
        if self.status is not Status.SUCCESS:
            return
        unlisten = self._context.cell.world.listen(self._tell_world)
        try:
            contradiction = self._devices.contradiction()
        finally:
            unlisten()
        if contradiction is not None:
            self.status, self.failure = Status.FAILURE, self._refutation(contradiction)

    def pause(self) -> None:
        """Let everything that runs hold still; the run's time stands still too."""
        if self.status is not RUNNING or self.paused:
            return
        self._paused_at = self._context.cell.now
        self._told_of(Paused)
        try:
            self._root.pause()
        except Exception as error:  # noqa: BLE001  the task's boundary: it reports, halts and ends
            self.abort(error)

    def resume(self) -> None:
        """Go on after `pause`."""
        if self._paused_at is None or self.status is not RUNNING:
            return
        self._context.paused_s += self._context.cell.now - self._paused_at
        self._paused_at = None
        self._told_of(Resumed)
        try:
            self._root.resume()
        except Exception as error:  # noqa: BLE001  the task's boundary: it reports, halts and ends
            self.abort(error)

    def _beat(self) -> None:
        cell = self._context.cell
        if not cell.watchdog.beat(self, cell.now):
            raise Silence("the tree was not ticked for too long, so everything was stopped")

    def _contradiction(self) -> str | None:
        """Withdraw what a device contradicts; return that in words."""
        found = self._devices.contradiction()
        if found is not None:
            self._context.refresh()
        return found

    def _refuted(self, contradiction: str) -> Status:
        """Fail because a device contradicts what the world model says: halt everything that runs."""
        self._root.halt(contradiction)
        return self._ended(Status.FAILURE, self._refutation(contradiction))

    def _refutation(self, contradiction: str) -> Failure:
        return Failure(kind="contradiction", message=contradiction, source=self._root.source)

    def _still_there(self) -> Status:
        """Give a sign of life while paused."""
        try:
            self._beat()
        except Silence as silence:
            self.abort(silence)
        return self.status

    def _start(self) -> Status:
        self.status = RUNNING
        return self._strand.start()

    def _ended(self, status: Status, failure: Failure | None) -> Status:
        for problem in self._undo.unwind():
            self._context.note(f"not undone at the end: {problem}")
        if self._unlisten is not None:
            self._unlisten()
        self._context.cell.watchdog.retire(self)
        self.status, self.failure, self._paused_at = status, failure, None
        return status

    def _told_of(self, event: type[Paused | Resumed]) -> None:
        self._context.begin_tick()
        if self._context.emit is not None:
            self._context.emit(event(time=self._context.time))

    def _tell_world(self, event: ChangeEvent) -> None:
        self._listeners(world_changed(event, self._context.time))


def _claims(node: Node) -> Iterator[Claim]:
    if not isinstance(node, CallNode):
        for child in node.children:
            yield from _claims(child)
    elif node.activation is not None and node.status is Status.SUCCESS:
        frame = dict(node.activation.frame)
        yield from ((post.condition, frame) for post in node.activation.implementation.post)
