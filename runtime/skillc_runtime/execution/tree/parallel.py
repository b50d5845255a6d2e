"""Children that run in parallel, with the four policies that decide the result."""

from __future__ import annotations

from typing import ClassVar

from skillc_runtime.execution.tree.active_path import ActivePath
from skillc_runtime.execution.tree.node import FAILURE, RUNNING, SUCCESS, Node
from skillc_runtime.execution.tree.selector import combine_failures
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.recording.failure import Failure


class ParallelNode(Node):
    """Starts the children in order and ticks those that run in the same order; each child runs once."""

    kind: ClassVar[str] = "par"
    __slots__ = ("_running", "_started")

    def on_start(self) -> Status:
        self._running: list[ActivePath] = []
        self._started = 0
        for child in self.children:
            self._started += 1
            path = ActivePath(child)
            if path.start() is RUNNING:
                self._running.append(path)
            elif self.decides(child):
                return self._finish_with(child)
        return RUNNING if self.joint_result() is None else self._finish_jointly()

    def tick(self) -> Status:
        finished = False
        for path in self._running:
            status = path.tick_leaf()
            if status is not RUNNING and path.propagate(status) is not RUNNING:
                if self.decides(path.top):
                    return self._finish_with(path.top)
                finished = True
        return self._drop_finished() if finished else RUNNING

    def decides(self, child: Node) -> bool:
        """Whether a child that just ended decides the result at once."""
        raise NotImplementedError

    def joint_result(self) -> Status | None:
        """Return the result after all running children were ticked, or None to continue."""
        return None if self._running else SUCCESS

    def remains_satisfied(self) -> bool:
        if self.status is not SUCCESS:
            return False
        return all(child.remains_satisfied() for child in self.children[: self._started] if child.status is SUCCESS)

    def _drop_finished(self) -> Status:
        self._running = [path for path in self._running if path.top.status is RUNNING]
        return RUNNING if self.joint_result() is None else self._finish_jointly()

    def _finish_with(self, child: Node) -> Status:
        outcome = "finished" if child.status is SUCCESS else "failed"
        self.stop(f"{child.name}, which runs in parallel, {outcome}")
        return self.succeed() if child.status is SUCCESS else self.fail(child.failure)

    def _finish_jointly(self) -> Status:
        return self.succeed() if self.joint_result() is SUCCESS else self.fail(self.joint_failure())

    def joint_failure(self) -> Failure:
        """Return the failure of the node if no single child decided the result."""
        return combine_failures(self)


class ParallelAll(ParallelNode):
    """Succeeds when all have succeeded; the first failure halts the others."""

    kind: ClassVar[str] = "par all"
    __slots__ = ()

    def decides(self, child: Node) -> bool:
        return child.status is FAILURE


class ParallelAny(ParallelNode):
    """Succeeds with the first success, which halts the others; fails when all have failed."""

    kind: ClassVar[str] = "par any"
    __slots__ = ()

    def decides(self, child: Node) -> bool:
        return child.status is SUCCESS

    def joint_result(self) -> Status | None:
        return None if self._running else FAILURE


class ParallelLead(ParallelNode):
    """The first child decides; the results of the others are ignored."""

    kind: ClassVar[str] = "par lead"
    __slots__ = ()

    def decides(self, child: Node) -> bool:
        return child is self.children[0]


class ParallelRace(ParallelNode):
    """The children that end first decide, after all were ticked; a failure takes precedence over a success."""

    kind: ClassVar[str] = "par race"
    __slots__ = ()

    def decides(self, child: Node) -> bool:
        return False

    def joint_result(self) -> Status | None:
        ended = {child.status for child in self.children}
        return FAILURE if FAILURE in ended else SUCCESS if SUCCESS in ended or not self._running else None

    def _finish_jointly(self) -> Status:
        decisive = next(child for child in self.children if child.status is self.joint_result())
        return self._finish_with(decisive)
