"""Children that run in parallel, with the four policies that decide the result."""

from __future__ import annotations

from collections.abc import Collection
from typing import ClassVar

from skillc_dsl.position import Position
from skillc_runtime.execution.tree.active_path import ActivePath
from skillc_runtime.execution.tree.context import TreeContext
from skillc_runtime.execution.tree.locks import Holders
from skillc_runtime.execution.tree.node import FAILURE, RUNNING, SUCCESS, Node
from skillc_runtime.execution.tree.nodes.selector import combine_failures
from skillc_runtime.primitives.primitive import Status


class ParallelNode(Node):
    """Starts the children in order and ticks those that run in the same order; each child runs once."""

    kind: ClassVar[str] = "par"
    __slots__ = ("_running", "_started")

    def foresee(self, freed: Holders) -> Status:
        statuses = []
        for child in self.children:
            statuses.append(child.dry_start(freed))
            if statuses[-1] is not RUNNING and self.decides(child, statuses[-1]):
                return statuses[-1]
        return self.joint_result(statuses)

    def on_start(self) -> Status:
        self._running: list[ActivePath] = []
        self._started = 0
        for child in self.children:
            self._started += 1
            path = ActivePath(child)
            if path.start() is RUNNING:
                self._running.append(path)
            elif self.decides(child, child.status):
                return self._finish_with(child)
        return self._finish_or_go_on()

    def tick(self) -> Status:
        finished = False
        for path in self._running:
            status = path.tick_leaf()
            if status is not RUNNING and path.propagate(status) is not RUNNING:
                if self.decides(path.top, path.top.status):
                    return self._finish_with(path.top)
                finished = True
        return self._drop_finished() if finished else RUNNING

    def decides(self, child: Node, status: Status) -> bool:
        """Whether a child that just ended with `status` decides the result at once."""
        raise NotImplementedError

    def joint_result(self, statuses: Collection[Status]) -> Status:
        """Return the result after all running children were ticked, given the status of each."""
        return RUNNING if RUNNING in statuses else SUCCESS

    def remains_satisfied(self) -> bool:
        if self.status is not SUCCESS:
            return False
        return all(child.remains_satisfied() for child in self.children[: self._started] if child.status is SUCCESS)

    def _drop_finished(self) -> Status:
        self._running = [path for path in self._running if path.top.status is RUNNING]
        return self._finish_or_go_on()

    def _finish_or_go_on(self) -> Status:
        status = self.joint_result({child.status for child in self.children})
        return RUNNING if status is RUNNING else self.finish_jointly(status)

    def _finish_with(self, child: Node) -> Status:
        outcome = "finished" if child.status is SUCCESS else "failed"
        self.stop(f"{child.name}, which runs in parallel, {outcome}")
        return self.succeed() if child.status is SUCCESS else self.fail(child.failure)

    def finish_jointly(self, status: Status) -> Status:
        """End if no single child has decided the result."""
        return self.succeed() if status is SUCCESS else self.fail(combine_failures(self))


class ParallelAll(ParallelNode):
    """Succeeds when all have succeeded; the first failure halts the others."""

    kind: ClassVar[str] = "par all"
    __slots__ = ()

    def decides(self, child: Node, status: Status) -> bool:
        return status is FAILURE


class ParallelInOrder(ParallelAll):
    """Starts a child as soon as those that it waits for have succeeded: `after` has their indices, for each child."""

    __slots__ = ("_after", "_waiting")

    def __init__(
        self,
        context: TreeContext,
        source: Position,
        children: tuple[Node, ...],
        after: tuple[tuple[int, ...], ...],
    ) -> None:
        super().__init__(context, source, children)
        self._after = after

    def foresee(self, freed: Holders) -> Status:
        first = [child for child, after in zip(self.children, self._after, strict=True) if not after]
        return FAILURE if FAILURE in [child.dry_start(freed) for child in first] else RUNNING

    def on_start(self) -> Status:
        self._running, self._started = [], len(self.children)
        self._waiting = list(range(len(self.children)))
        return self._start_next(done=set())

    def _drop_finished(self) -> Status:
        self._running = [path for path in self._running if path.top.status is RUNNING]
        left = {*self._waiting, *(self.children.index(path.top) for path in self._running)}
        return self._start_next(done={*range(len(self.children))} - left)

    def _start_next(self, done: set[int]) -> Status:
        """Start the children whose predecessors are done, and in turn those that wait for what is done at once."""
        for index in tuple(self._waiting):
            if done.issuperset(self._after[index]):
                self._waiting.remove(index)
                path = ActivePath(self.children[index])
                status = path.start()
                if status is RUNNING:
                    self._running.append(path)
                elif status is FAILURE:
                    return self._finish_with(path.top)
                else:
                    done.add(index)
        return RUNNING if self._running else self.succeed()


class ParallelAny(ParallelNode):
    """Succeeds with the first success, which halts the others; fails when all have failed."""

    kind: ClassVar[str] = "par any"
    __slots__ = ()

    def decides(self, child: Node, status: Status) -> bool:
        return status is SUCCESS

    def joint_result(self, statuses: Collection[Status]) -> Status:
        return RUNNING if RUNNING in statuses else FAILURE


class ParallelLead(ParallelNode):
    """The first child decides; the results of the others are ignored."""

    kind: ClassVar[str] = "par lead"
    __slots__ = ()

    def decides(self, child: Node, status: Status) -> bool:
        return child is self.children[0]


class ParallelRace(ParallelNode):
    """The children that end first decide, after all were ticked; a failure takes precedence over a success."""

    kind: ClassVar[str] = "par race"
    __slots__ = ()

    def decides(self, child: Node, status: Status) -> bool:
        return False

    def joint_result(self, statuses: Collection[Status]) -> Status:
        first = (status for status in (FAILURE, SUCCESS, RUNNING) if status in statuses)
        return next(first, SUCCESS)

    def finish_jointly(self, status: Status) -> Status:
        return self._finish_with(next(child for child in self.children if child.status is status))
