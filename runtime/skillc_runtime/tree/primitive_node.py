"""The leaf that runs a primitive skill and keeps the promises of its life cycle."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import ClassVar

from skillc_compiler.library.vocabulary import Position
from skillc_runtime.primitives.primitive import Primitive, SkillFailure, Status
from skillc_runtime.recording.failure import Failure
from skillc_runtime.tree.context import Context
from skillc_runtime.tree.errors import describe_exception
from skillc_runtime.tree.node import FAILURE, RUNNING, SUCCESS, Node
from skillc_runtime.tree.undo import Undo
from skillc_runtime.world.labelled import LabelledValue

NO_VALUES: Mapping[str, LabelledValue] = MappingProxyType({})


class PrimitiveNode(Node):
    """Makes one primitive, starts and ticks it; used for one run.

    A primitive that began to start is halted exactly once unless it refused to start or succeeded: because of a halt
    from above, or because it raised. `undo` is given for a scoped skill, whose primitive is released exactly once after
    it began to start, unless it refused to: at once when it does not succeed, else by `undo`. `refused` tells that it
    did not start; `restore` takes back what its posts wrote, after the release.
    """

    kind: ClassVar[str] = "primitive"
    __slots__ = ("_make", "_primitive", "_running", "_tick", "_undo", "outputs", "refused", "restore")

    def __init__(
        self, context: Context, source: Position, name: str, make: Callable[[], Primitive], undo: Undo | None
    ) -> None:
        super().__init__(context, source, name=name)
        self.refused = True
        self.restore: Callable[[], None] | None = None
        self.outputs: dict[str, object] = {}
        self._make = make
        self._undo = undo
        self._primitive: Primitive | None = None
        self._running = False

    def begin(self) -> Status:
        self._primitive = primitive = self._make()
        self._tick = primitive.tick
        self._running = True
        if self._undo is not None:
            self._undo.push(self.release)
        try:
            primitive.start()
        except SkillFailure as refusal:
            self._running = False
            if self._undo is not None:
                self._undo.drop(self.release)
            return self.fail(self._failure(str(refusal), refusal.values))
        self.refused = False
        return self.tick()

    def tick(self) -> Status:
        try:
            status = self._tick()
            if status is RUNNING:
                return RUNNING
            return self._finished(status)
        except SkillFailure as failure:
            return self._failed(str(failure), failure.values)
        except Exception as error:  # noqa: BLE001  the boundary to skill code: it reports, halts and fails
            return self.broken(error)

    def stop(self, reason: str) -> None:
        if self._running and self._primitive is not None:
            self._running = False
            try:
                self._primitive.halt(reason)
            except Exception as error:  # noqa: BLE001  the others must be halted too
                self.context.note(f"{self.name} could not be halted: {describe_exception(error)}", self.id, self.source)
        self.undo_now()

    def undo_now(self) -> None:
        """Release what the primitive set up, if that is still to be done."""
        problem = self._undo.run(self.release) if self._undo is not None else None
        if problem is not None:
            self.context.note(f"{self.name} could not be undone: {problem}", self.id, self.source)

    def release(self) -> None:
        """Undo what the primitive set up, then what its posts wrote; called by `undo`."""
        assert self._primitive is not None, "release before start"
        self._primitive.release()
        if self.restore is not None:
            self.restore()

    def pause(self) -> None:
        if self._running and self._primitive is not None:
            self._primitive.pause()

    def resume(self) -> None:
        if self._running and self._primitive is not None:
            self._primitive.resume()

    def _finished(self, status: Status) -> Status:
        if status is SUCCESS:
            assert self._primitive is not None, "finished before start"
            self._running = False
            self.outputs = dict(self._primitive.outputs)
            return self.end()
        if status is FAILURE:
            return self._failed(f"{self.name} failed and did not say why")
        raise TypeError(f"{self.name} returned {status!r} from tick; it may return RUNNING or SUCCESS")

    def _failed(self, message: str, values: Mapping[str, LabelledValue] = NO_VALUES) -> Status:
        self.stop(message)
        return self.fail(self._failure(message, values))

    def _failure(self, message: str, values: Mapping[str, LabelledValue]) -> Failure:
        return Failure(kind="body", message=message, source=self.source, values=dict(values))
