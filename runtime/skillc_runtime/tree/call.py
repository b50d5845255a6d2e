"""A call of a skill: chooses an implementation when it starts, guards it while it runs, concludes it when it ends."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar

from skillc_compiler.library import tree
from skillc_compiler.library.conditions import Variable
from skillc_compiler.library.skills import Implementation
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.selection.fit import fit
from skillc_runtime.selection.select import candidates, why_none
from skillc_runtime.trace.failure import Failure, Rejected, as_failure
from skillc_runtime.trace.reasons import Attempted
from skillc_runtime.tree.activation import Activation, Build, activate
from skillc_runtime.tree.context import Context
from skillc_runtime.tree.enclosing import Enclosing, Frame
from skillc_runtime.tree.errors import told
from skillc_runtime.tree.node import RUNNING, SUCCESS, Node
from skillc_runtime.tree.primitive_node import PrimitiveNode
from skillc_runtime.tree.strand import Strand
from skillc_runtime.tree.telling import attempted, chosen, facts_at_failure
from skillc_runtime.world.eval.expressions import value_of

_STAGES = ("argument", "inference", "pre", "hold", "lock", "start", "run")


class CallNode(Node):
    """Tries the implementations in rank order; each start evaluates the arguments and infers parameters anew.

    `rejected` are the implementations not taken at the last start, with their reasons; `activation` is the one taken.
    """

    kind: ClassVar[str] = "call"
    __slots__ = (
        "_arguments",
        "_began_in",
        "_build",
        "_enclosing",
        "_facts",
        "_left",
        "_strand",
        "activation",
        "node",
        "rejected",
        "skill",
    )

    def __init__(self, context: Context, node: tree.Call, enclosing: Enclosing, build: Build) -> None:
        super().__init__(context, node.source, name=node.skill)
        self.node = node
        self.skill = context.library.skills[node.skill]
        self.activation: Activation | None = None
        self.rejected: list[Rejected] = []
        self._arguments: Frame = {}
        self._facts: tuple[str, ...] | None = None
        self._enclosing = enclosing
        self._build = build

    def begin(self) -> Status:
        self.rejected = []
        self.activation = None
        self.children = ()
        self._arguments, self._facts = {}, None
        self._began_in = self.context.state
        self._arguments = self._evaluated_arguments()
        self._left = iter(candidates(self.context.library, self.node.skill, self.node.implementation))
        return self._try_next(self._left)

    def tick(self) -> Status:
        activation = self.activation
        assert activation is not None, "tick before start"
        failure = self._broken(activation)
        if failure is not None:
            self._look()
            activation.body.halt(failure.message)
            return self._failed(activation, failure)
        status = self._strand.pulse()
        return RUNNING if status is RUNNING else self.after(self._strand.climb(status))

    def lowest(self) -> Node:
        """Pass ticks on to the body unless there are holds or `verify` lines to watch."""
        activation = self.activation
        return self if activation is None or activation.watchful else activation.body.lowest()

    def after(self, status: Status) -> Status:
        activation = self.activation
        if status is RUNNING or activation is None:
            return status
        if status is not SUCCESS:
            return self._failed(activation, self._with_skill(activation.body.failure))
        try:
            failure = activation.conclude()
            if failure is None:
                self._hand_out(activation)
        except Exception as error:  # noqa: BLE001  a node is the boundary: it reports and fails
            failure = Failure(kind="error", message=told(error), source=self.source, skill=self.skill.name)
        if failure is not None:
            return self._failed(activation, failure)
        activation.close()
        return self.end()

    def stop(self, reason: str) -> None:
        super().stop(reason)
        self.context.locks.give_back(self)

    def still(self) -> bool:
        return self.status is SUCCESS and (self.activation is None or self.activation.posts_hold())

    def _evaluated_arguments(self) -> Frame:
        """Evaluate the arguments; an optional parameter from around that was not passed is not passed on."""
        frame, state = self._enclosing.frame, self.context.state
        unset = {
            name
            for name, value in self.node.arguments.items()
            if isinstance(value, Variable) and value.name not in frame and self._enclosing.optional(value.name)
        }
        given = {name: value for name, value in self.node.arguments.items() if name not in unset}
        return {name: value_of(value, state, frame) for name, value in given.items()}

    def _try_next(self, implementations: Iterator[Implementation]) -> Status:
        for implementation in implementations:
            activation = self._activated(implementation)
            if isinstance(activation, Rejected):
                self.rejected.append(activation)
                if activation.stage not in ("run", "lock"):
                    self._remember(activation.implementation, activation.reason)
                continue
            status = self._start(activation)
            if status is not None:
                return status
        return self.fail(self._none_left())

    def _activated(self, implementation: Implementation) -> Activation | Rejected:
        try:
            repeated = self._repeated(implementation)
            if repeated is not None:
                return repeated
            fitted = fit(implementation, self._arguments, self.context.state)
            if isinstance(fitted, Rejected):
                return fitted
            for note in fitted.notes:
                self.context.note(note, self.id, self.source)
            return activate(self.context, self.skill, fitted, self, self._enclosing, self._build)
        except Exception as error:  # noqa: BLE001  one implementation that cannot start leaves the others their chance
            return self._refusal(implementation, Failure(kind="error", message=told(error), source=self.source))

    def _start(self, activation: Activation) -> Status | None:
        """Start the body; None when it did not get to start and the next implementation may be tried."""
        self.activation, self.children = activation, (activation.body,)
        activation.body.up = self
        self._strand = Strand(activation.body)
        self.name = f"{self.skill.name}[{activation.implementation.name}]"
        self._tell_choice(activation)
        status = self._strand.start()
        if status is RUNNING:
            return RUNNING
        if isinstance(activation.body, PrimitiveNode) and activation.body.refused:
            activation.close()
            failure = self._with_skill(activation.body.failure)
            self._remember(activation.implementation.name, failure.message)
            self.rejected.append(self._refusal(activation.implementation, failure))
            return None
        return self.after(status)

    def _failed(self, activation: Activation, failure: Failure) -> Status:
        """Give everything back, then try the next implementation where the skill allows it."""
        self._look()
        if isinstance(activation.body, PrimitiveNode):
            activation.body.undo_now()
        activation.close()
        self._remember(activation.implementation.name, failure.message)
        if not self.skill.fallback:
            return self.fail(failure)
        self.context.refresh()
        self.rejected.append(self._refusal(activation.implementation, failure, ran=True))
        self._facts = None
        return self._try_next(self._left)

    def _repeated(self, implementation: Implementation) -> Rejected | None:
        """Return why an implementation is not taken that failed in a former attempt and can only fail again."""
        failures, name = self._enclosing.failures, implementation.name
        why = failures and failures.reason(self.skill.name, self._arguments, name, self.context.state)
        return Rejected(implementation=name, stage="run", reason=why, source=implementation.source) if why else None

    def _remember(self, implementation: str, why: str) -> None:
        """Note a failure for the attempts to come."""
        if self._enclosing.failures is not None:
            self._enclosing.failures.add(self.skill.name, self._arguments, implementation, self._began_in, why)

    def _broken(self, activation: Activation) -> Failure | None:
        """Look at the holds in a new state, at what is forbidden in every tick."""
        try:
            broken = activation.broken_hold() if self.context.state is not activation.checked else None
            return broken or (activation.violation() if activation.implementation.verify else None)
        except Exception as error:  # noqa: BLE001  a node is the boundary: it reports, halts and fails
            return Failure(kind="error", message=told(error), source=self.source, skill=self.skill.name)

    def _hand_out(self, activation: Activation) -> None:
        if self.node.out is not None:
            self._enclosing.frame[self.node.out] = activation.frame[activation.outputs[0]]

    def _none_left(self) -> Failure:
        causes = tuple(as_failure(refusal, self.skill.name) for refusal in self.rejected)
        if len(causes) == 1:
            return causes[0]
        furthest = max(self.rejected, key=lambda refusal: _STAGES.index(refusal.stage), default=None)
        kind = as_failure(furthest, self.skill.name).kind if furthest is not None else "error"
        message = why_none(self.skill.name, self.rejected)
        return Failure(kind=kind, message=message, source=self.source, skill=self.skill.name, causes=causes)

    def _refusal(self, implementation: Implementation, failure: Failure, ran: bool = False) -> Rejected:
        return Rejected(
            implementation=implementation.name,
            stage="run" if ran else "start",
            reason=failure.message,
            source=failure.source or implementation.source,
            failure=failure,
        )

    def _with_skill(self, failure: Failure | None) -> Failure:
        """Name this skill in a failure of its body that names none yet."""
        if failure is None:
            return Failure(kind="body", message=f"{self.name} failed", source=self.source, skill=self.skill.name)
        if failure.skill:
            return failure
        return Failure(
            kind=failure.kind,
            message=failure.message,
            source=failure.source,
            skill=self.skill.name,
            causes=failure.causes,
        )

    def attempted(self) -> Attempted:
        self._look()
        return attempted(self.skill, self._arguments, self.rejected, self._facts or (), self.context)

    def _look(self) -> None:
        """Keep what the conditions read when something fails, before what is undone changes it; once a failure."""
        if self.context.emit is not None and self._facts is None:
            tried = candidates(self.context.library, self.node.skill, self.node.implementation)
            self._facts = facts_at_failure(tried, self.activation, self._arguments, self.context.state)

    def _tell_choice(self, activation: Activation) -> None:
        if self.context.emit is not None:
            event = chosen(self.id, self.node, activation, self._arguments, self.rejected, self.context)
            self.context.emit(event)
