"""The computations of the primitives of a tree, each in a process beside the ticks that can be killed at any time."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import assert_never

from skillc_runtime.cancellation import CancelToken
from skillc_runtime.execution.worker_process import Died, Raised, Returned, WorkerProcess, WorkerResult, wait_for_any
from skillc_runtime.primitives.computation import Computation, Computing
from skillc_runtime.primitives.primitive import Primitive, SkillFailure
from skillc_runtime.world.state.python_calls import foreign_code


class Computations:
    """Lets the primitives of a tree compute. Processes are used again, and all are killed by `close`."""

    def __init__(self) -> None:
        self._running = dict[Primitive, _Running]()
        self._idle: list[WorkerProcess] = []

    @property
    def awaited(self) -> bool:
        """Whether a primitive waits for a result, which may have arrived."""
        return bool(self._running)

    @property
    def pending(self) -> bool:
        """Whether a computation goes on that has no result yet."""
        return bool(self._running) and any(each.poll() is None for each in self._running.values())

    def wait(self, seconds: float) -> None:
        """Wait for up to `seconds` of wall time for a result, or until the time of a computation is up."""
        running = [each for each in self._running.values() if each.poll() is None]
        wait_for_any([each.worker for each in running], min([seconds, *(each.limit.remaining_s for each in running)]))

    def proceed(self, primitive: Primitive) -> bool:
        """Let a primitive go on if what it waits for has arrived; return whether it still computes.

        It raises what `computing` raises: SkillFailure, or whatever code of users does.
        """
        computing, running, result = primitive.computing, self._running.get(primitive), None
        assert computing is not None, "it computes"
        if running is not None:
            if (result := running.poll()) is None:
                return True
            del self._running[primitive]
            if not isinstance(result, Died):
                self._idle.append(running.worker)
        primitive.computing = None
        try:
            with foreign_code:
                wanted = computing.send(None) if running is None else _pass_on(result, running.wanted, computing)
        except StopIteration:
            return False
        if wanted is not None:
            self._running[primitive] = self._begin(wanted)
        primitive.computing = computing
        return True

    def cancel(self, primitive: Primitive) -> None:
        """End at once what a primitive computes, if it does."""
        if (running := self._running.pop(primitive, None)) is not None:
            running.worker.kill_at_once("it is not wanted any more")
        if (computing := primitive.computing) is not None:
            primitive.computing = None
            with foreign_code:
                computing.close()

    def close(self) -> None:
        """End everything."""
        for worker in (*self._idle, *(each.worker for each in self._running.values())):
            worker.kill_at_once("it is not wanted any more")
        self._idle, self._running = [], {}

    def _begin(self, wanted: Computation) -> _Running:
        """Give a computation to a process. TypeError if it cannot be passed to one; OSError if there is none."""
        worker = self._idle.pop() if self._idle else WorkerProcess(_compute)
        try:
            worker.ask(wanted)
        except Exception as error:  # the boundary to `pickle`, which raises anything
            self._idle.append(worker)
            raise TypeError(f"{wanted} cannot be done in another process: {error}") from error
        return _Running(wanted, worker, CancelToken(wanted.limit_s))


@dataclass(frozen=True, slots=True)
class _Running:
    """A computation that goes on, until it has a result or its time is up."""

    wanted: Computation
    worker: WorkerProcess
    limit: CancelToken = field(compare=False)

    def poll(self) -> WorkerResult | None:
        """Return its result, None if there is none yet; one that takes too long is killed."""
        result = self.worker.poll()
        if result is None and self.limit.reason is not None:
            self.worker.kill_at_once(f"it took longer than {self.wanted.limit_s:g} s")
            return self.worker.poll()
        return result


def _compute(wanted: Computation) -> object:
    """Do what is wanted, in a process of its own; a SkillFailure is a result like others."""
    try:
        return wanted.function(*wanted.arguments)
    except SkillFailure as failure:
        return failure


def _pass_on(result: WorkerResult | None, wanted: Computation, computing: Computing) -> Computation | None:
    """Let a primitive go on with a result, or raise in it why there is none."""
    match result:
        case Returned(SkillFailure() as failure):
            return computing.throw(failure)
        case Returned(value):
            return computing.send(value)
        case Raised(why):
            return computing.throw(RuntimeError(f"{wanted}: {why}"))
        case Died(why):
            return computing.throw(SkillFailure(f"{wanted} was given up: {why}"))
        case None:
            raise AssertionError("a result has arrived")
        case _:
            assert_never(result)
