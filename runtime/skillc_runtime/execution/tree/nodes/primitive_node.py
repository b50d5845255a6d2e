"""The leaf that runs a primitive and enforces its life cycle."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import ClassVar

from skillc_dsl.position import Position
from skillc_runtime.execution.tree.context import TreeContext
from skillc_runtime.execution.tree.errors import describe_exception
from skillc_runtime.execution.tree.node import FAILURE, RUNNING, SUCCESS, Node
from skillc_runtime.execution.tree.undo_stack import UndoStack
from skillc_runtime.primitives.primitive import Primitive, SkillFailure, SpaceLacking, Status
from skillc_runtime.recording.failure import Failure, FailureKind
from skillc_runtime.world.state.python_calls import FOREIGN_ERRORS, foreign_code


class PrimitiveNode(Node):
    """Creates one primitive, starts it and ticks it; used for one run.

    After `start` was called, the primitive is halted exactly once, when the parent is halted or the primitive raises,
    except if `start`, or what it computes, refused (`refused_to_start`) or `tick` succeeded. A scoped skill passes
    `undo`: its primitive is released exactly once unless `start` refused, immediately if it does not succeed, else by
    `undo`. After the release `undo_posts` undoes the changes written by the posts. From its start until it ends, or is
    released, a pause of the run concerns it. `done_by` is the primitive once it has succeeded.
    """

    kind: ClassVar[str] = "primitive"
    __slots__ = (
        "_late",
        "_make",
        "_primitive",
        "_running",
        "_tick",
        "_undo",
        "done_by",
        "outputs",
        "refused_to_start",
        "undo_posts",
    )

    def __init__(
        self, context: TreeContext, source: Position, name: str, make: Callable[[], Primitive], undo: UndoStack | None
    ) -> None:
        super().__init__(context, source, name=name)
        self.refused_to_start = True
        self.undo_posts: Callable[[], None] | None = None
        self.outputs: dict[str, object] = {}
        self.done_by: Primitive | None = None
        self._make = make
        self._undo = undo
        self._primitive: Primitive | None = None
        self._running = False

    def on_start(self) -> Status:
        with foreign_code:
            self._primitive = primitive = self._make()
            primitive.planned_postures = self.context.planned_postures
        self._tick, self._late = primitive.tick, self.context.find_step_end()
        self._running = True
        if self._undo is not None:
            self._undo.push(self.release)
        try:
            with foreign_code:
                primitive.start()
        except SkillFailure as refusal:
            return self._refuse(refusal)
        self.refused_to_start = primitive.computing is not None
        self.context.active.add(primitive, self.id)
        return self.tick()

    def tick(self) -> Status:
        try:
            status = RUNNING if self._computes() else self._tick()
            self._tell()
            if status is not RUNNING:
                return self._on_finished(status)
            if self.context.now < self._late:
                return RUNNING
            self.refused_to_start = False
            return self.fail_late()
        except SkillFailure as failure:
            if self.refused_to_start:
                return self._refuse(failure)
            return self._halt_and_fail(failure)
        except KeyboardInterrupt:
            raise
        except BaseException as error:  # noqa: BLE001  the boundary to skill code: it reports, halts and fails
            return self.fail_with_error(error)

    def stop(self, reason: str) -> None:
        if self._running and self._primitive is not None:
            self._running = False
            self.context.active.discard(self._primitive)
            self._try_to_halt(partial(self.context.computations.cancel, self._primitive))
            self._try_to_halt(partial(self._primitive.halt, reason))
        self.undo_now()

    def _try_to_halt(self, halt: Callable[[], None]) -> None:
        """Call a function; if it fails, that is told, since the other nodes must be halted too."""
        try:
            with foreign_code:
                halt()
        except FOREIGN_ERRORS as error:
            self.context.note(f"{self.name} could not be halted: {describe_exception(error)}", self.id, self.source)

    def undo_now(self) -> None:
        """Release the primitive if it was not released yet."""
        problem = self._undo.undo_one(self.release) if self._undo is not None else None
        if problem is not None:
            self.context.note(f"{self.name} could not be undone: {problem}", self.id, self.source)

    def release(self) -> None:
        """Release the primitive, then undo the changes written by its posts; called by the undo stack."""
        assert self._primitive is not None, "release before start"
        self.context.active.discard(self._primitive)
        with foreign_code:
            self._primitive.release()
        if self.undo_posts is not None:
            self.undo_posts()

    def _tell(self) -> None:
        """Tell users what the primitive has to say."""
        assert self._primitive is not None, "ticked before start"
        if self._primitive.note:
            self.context.note(self._primitive.note, self.id, self.source)
            self._primitive.note = ""

    def _computes(self) -> bool:
        """Whether the primitive computes, after it has gone on with what has arrived."""
        assert self._primitive is not None, "ticked before start"
        if self._primitive.computing is None:
            return False
        computes = self.context.computations.proceed(self._primitive)
        self.refused_to_start &= computes
        return computes

    def _refuse(self, refusal: SkillFailure) -> Status:
        """Fail because the primitive refuses to start; nothing has moved."""
        assert self._primitive is not None, "refused before start"
        self._running = False
        self.context.active.discard(self._primitive)
        if self._undo is not None:
            self._undo.discard(self.release)
        return self.fail(self._failure(refusal))

    def _on_finished(self, status: Status) -> Status:
        if status is SUCCESS:
            assert self._primitive is not None, "finished before start"
            self._running = False
            if self._undo is None:
                self.context.active.discard(self._primitive)
            self.outputs = dict(self._primitive.outputs)
            self.done_by = self._primitive
            return self.succeed()
        if status is FAILURE:
            return self._halt_and_fail(SkillFailure(f"{self.name} failed without a reason"))
        raise TypeError(f"{self.name} returned {status!r} from tick; it may return RUNNING or SUCCESS")

    def _halt_and_fail(self, failure: SkillFailure) -> Status:
        self.stop(str(failure))
        return self.fail(self._failure(failure))

    def _failure(self, failure: SkillFailure) -> Failure:
        lacks_space: FailureKind = "space" if isinstance(failure, SpaceLacking) else "body"
        return Failure(
            kind=lacks_space if failure.withdrawn is None else "contradiction",
            message=str(failure),
            detail=f"withdrawn: {', '.join(failure.withdrawn)}" if failure.withdrawn else "",
            source=self.source,
            values=dict(failure.values),
        )
