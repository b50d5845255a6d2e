"""Children together, with the four ways in which they decide."""

from __future__ import annotations

from typing import ClassVar

from skillc_runtime.primitives.primitive import Status
from skillc_runtime.recording.failure import Failure
from skillc_runtime.tree.node import FAILURE, RUNNING, SUCCESS, Node
from skillc_runtime.tree.selector import all_failed
from skillc_runtime.tree.strand import Strand


class ParallelNode(Node):
    """Starts the children in order and ticks those that run in the same order; a finished one keeps its result."""

    kind: ClassVar[str] = "par"
    __slots__ = ("_running", "_started")

    def begin(self) -> Status:
        self._running: list[Strand] = []
        self._started = 0
        for child in self.children:
            self._started += 1
            strand = Strand(child)
            if strand.start() is RUNNING:
                self._running.append(strand)
            elif self.decided_by(child):
                return self._decide(child)
        return RUNNING if self.decided_late() is None else self._decide_late()

    def tick(self) -> Status:
        finished = False
        for strand in self._running:
            status = strand.pulse()
            if status is not RUNNING and strand.climb(status) is not RUNNING:
                if self.decided_by(strand.top):
                    return self._decide(strand.top)
                finished = True
        return self._after_finishing() if finished else RUNNING

    def decided_by(self, child: Node) -> bool:
        """Whether a child that just finished decides at once."""
        raise NotImplementedError

    def decided_late(self) -> Status | None:
        """The result once all running children had their tick; None to go on."""
        return None if self._running else SUCCESS

    def still(self) -> bool:
        if self.status is not SUCCESS:
            return False
        return all(child.still() for child in self.children[: self._started] if child.status is SUCCESS)

    def _after_finishing(self) -> Status:
        self._running = [strand for strand in self._running if strand.top.status is RUNNING]
        return RUNNING if self.decided_late() is None else self._decide_late()

    def _decide(self, child: Node) -> Status:
        outcome = "finished" if child.status is SUCCESS else "failed"
        self.stop(f"{child.name} beside it {outcome}")
        return self.end() if child.status is SUCCESS else self.fail(child.failure)

    def _decide_late(self) -> Status:
        return self.end() if self.decided_late() is SUCCESS else self.fail(self.reason())

    def reason(self) -> Failure:
        """The failure when no child decided at once."""
        return all_failed(self)


class ParallelAll(ParallelNode):
    """Success when all have succeeded; the first failure halts the others."""

    kind: ClassVar[str] = "par all"
    __slots__ = ()

    def decided_by(self, child: Node) -> bool:
        return child.status is FAILURE


class ParallelAny(ParallelNode):
    """The first success decides; failure when all failed."""

    kind: ClassVar[str] = "par any"
    __slots__ = ()

    def decided_by(self, child: Node) -> bool:
        return child.status is SUCCESS

    def decided_late(self) -> Status | None:
        return None if self._running else FAILURE


class ParallelLead(ParallelNode):
    """The first child decides; the others run beside it and their ends change nothing."""

    kind: ClassVar[str] = "par lead"
    __slots__ = ()

    def decided_by(self, child: Node) -> bool:
        return child is self.children[0]


class ParallelRace(ParallelNode):
    """All have their tick, then those that finished decide: a failure wins over a success."""

    kind: ClassVar[str] = "par race"
    __slots__ = ()

    def decided_by(self, child: Node) -> bool:
        return False

    def decided_late(self) -> Status | None:
        ended = {child.status for child in self.children}
        return FAILURE if FAILURE in ended else SUCCESS if SUCCESS in ended or not self._running else None

    def _decide_late(self) -> Status:
        decisive = next(child for child in self.children if child.status is self.decided_late())
        return self._decide(decisive)
