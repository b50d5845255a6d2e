"""The life cycle of a node: it starts, is ticked while it runs, and ends or is halted."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar

from skillc_dsl.position import Position
from skillc_runtime.execution.tree.context import TreeContext
from skillc_runtime.execution.tree.errors import make_error
from skillc_runtime.execution.tree.locks import Holders
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.primitives.time_limits import describe_slowness
from skillc_runtime.recording.events import NodeEnded, NodeStarted
from skillc_runtime.recording.failure import Failure
from skillc_runtime.recording.reasons import FailedCallContext
from skillc_runtime.world.state.labels.labelled import LabelledValue
from skillc_runtime.world.state.python_calls import FOREIGN_ERRORS

RUNNING, SUCCESS, FAILURE, HALTED = Status.RUNNING, Status.SUCCESS, Status.FAILURE, Status.HALTED


class Node:
    """A node of a running tree: its `parent` starts it and it is ticked until it ends or is halted.

    A subclass implements `on_start`. A node with work in each tick, such as ticking several children or evaluating a
    condition, also implements `tick`. A node that only passes ticks on to one child at a time implements `active_leaf`
    and `on_child_ended` instead, and is skipped while the child runs. `on_start`, `tick` and `on_child_ended` return
    RUNNING or the result of `succeed` or `fail`. Children start in the order of `children`. `foresee` says what can
    be said of a start without starting anything.
    """

    kind: ClassVar[str]
    __slots__ = ("children", "context", "ended", "failure", "id", "name", "parent", "source", "started", "status")

    def __init__(self, context: TreeContext, source: Position, children: tuple[Node, ...] = (), name: str = "") -> None:
        self.context = context
        self.source = source
        self.children = children
        self.name = name or self.kind
        self.id = context.next_id()
        self.parent: Node | None = None
        self.status = Status.IDLE
        self.failure: Failure | None = None
        self.started: float | None = None
        self.ended: float | None = None
        for child in children:
            child.parent = self

    def dry_start(self, freed: Holders) -> Status:
        """Return how `start` would end its first tick, as far as its leading part decides that; nothing is changed.

        RUNNING if it would begin to do something, of which only doing it shows how it ends; FAILURE if an exception is
        raised. The devices that the calls `freed` hold count as free.
        """
        try:
            return self.foresee(freed)
        except FOREIGN_ERRORS:  # a start would fail with it, and then report it
            return FAILURE

    def foresee(self, freed: Holders) -> Status:
        """Evaluate the leading part without side effects; called by `dry_start`."""
        return RUNNING

    def descendants(self) -> Iterator[Node]:
        """Yield the node and all nodes below it."""
        yield self
        for child in self.children:
            yield from child.descendants()

    def start(self) -> Status:
        """Start the node, do the work of the first tick and return the status; an exception becomes a failure."""
        context = self.context
        context.happenings += 1
        self.status = RUNNING
        self.failure = None
        self.started, self.ended = context.time, None
        if context.emit is not None:
            parent = 0 if self.parent is None else self.parent.id
            started = NodeStarted(
                time=context.time, node=self.id, parent=parent, kind=self.kind, name=self.name, source=self.source
            )
            context.emit(started)
        try:
            return self.on_start()
        except FOREIGN_ERRORS as error:  # a node is the boundary: it reports, halts and fails
            return self.fail_with_error(error)

    def on_start(self) -> Status:
        """Do the work of the first tick; called by `start`."""
        raise NotImplementedError

    def tick(self) -> Status:
        """Do the work of one tick."""
        raise NotImplementedError

    def active_leaf(self) -> Node:
        """Return the node to tick in place of this one: itself, or the active leaf of its running child."""
        return self

    def on_child_ended(self, status: Status) -> Status:
        """Continue after the running child ended with `status`."""
        raise NotImplementedError

    def halt(self, reason: str) -> None:
        """Halt the node if it runs, and all running descendants, the last started first."""
        if self.status is RUNNING:
            self.stop(reason)
            self._finish(HALTED, Failure(kind="halted", message=reason, source=self.source))

    def stop(self, reason: str) -> None:
        """Halt all running descendants; a subclass adds its own cleanup. Never raises."""
        for child in reversed(self.children):
            child.halt(reason)

    def remains_satisfied(self) -> bool:
        """Whether the node has succeeded and its result is still valid in the current world."""
        return self.status is SUCCESS

    def would_fail_again(self) -> bool:
        """Whether a failed node would fail again in the current world; used by `invert` only."""
        return self.status is FAILURE

    def succeed(self) -> Status:
        """Record success."""
        return self._finish(SUCCESS, None)

    def fail(self, failure: Failure | None) -> Status:
        """Record a failure; None if a child failed without details."""
        return self._finish(FAILURE, failure or Failure(kind="body", message=f"{self.name} failed", source=self.source))

    def fail_with_error(self, error: BaseException) -> Status:
        """Halt all running descendants and fail because of an exception."""
        failure = make_error(error, self.source)
        self.stop(failure.message)
        return self.fail(failure)

    def fail_late(self) -> Status:
        """Halt the node and fail because it has reached the deadline of each step."""
        spec = self.context.spec
        late = f"{self.name} was not done after {spec.step_deadline_s:g} s, the deadline of each step"
        message = f"{late}{describe_slowness(spec.speed)}"
        self.stop(message)
        return self.fail(Failure(kind="timeout", message=message, source=self.source))

    def describe_call(self) -> FailedCallContext | None:
        """Return the details of a failed call, or None for other nodes; only called if there are listeners."""
        return None

    def describe_outputs(self) -> dict[str, LabelledValue]:
        """Return what a call has returned, by parameter name; only called if there are listeners."""
        return {}

    def _finish(self, status: Status, failure: Failure | None) -> Status:
        context = self.context
        context.happenings += 1
        self.status, self.failure, self.ended = status, failure, context.time
        if context.emit is not None:
            ended = NodeEnded(
                time=context.time,
                node=self.id,
                name=self.name,
                status=status.value,
                failure=failure,
                failed_call=self.describe_call() if status is FAILURE else None,
                outputs=self.describe_outputs() if status is SUCCESS else {},
                source=self.source,
            )
            context.emit(ended)
        return status
