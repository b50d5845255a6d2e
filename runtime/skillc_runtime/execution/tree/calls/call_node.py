"""A call of a skill: it selects an implementation, monitors it while it runs, and applies its results when it ends."""

from __future__ import annotations

from collections.abc import Iterator

from msgspec import structs

from skillc_dsl.position import Position
from skillc_model import tree
from skillc_model.skills import Implementation
from skillc_runtime.execution.selection.select import combine_rejections, ranked_implementations
from skillc_runtime.execution.tree.active_path import ActivePath
from skillc_runtime.execution.tree.calls.activating import (
    BuildNode,
    activate,
    bind_unlocked,
    find_used,
    foresee_implementation,
)
from skillc_runtime.execution.tree.calls.activation import Activation
from skillc_runtime.execution.tree.calls.argument_origins import EnclosingBody
from skillc_runtime.execution.tree.calls.call_decision import evaluate_arguments
from skillc_runtime.execution.tree.calls.event_factory import (
    collect_facts_at_failure,
    label_outputs,
    make_choice_event,
    make_failure_context,
)
from skillc_runtime.execution.tree.calls.waiting import WaitingCall
from skillc_runtime.execution.tree.calls.withdrawn_facts import lead_with_withdrawal
from skillc_runtime.execution.tree.context import TreeContext
from skillc_runtime.execution.tree.errors import make_error
from skillc_runtime.execution.tree.lexical_scope import Frame, LexicalScope
from skillc_runtime.execution.tree.locks import Holders
from skillc_runtime.execution.tree.node import FAILURE, RUNNING, SUCCESS, Node
from skillc_runtime.execution.tree.nodes.primitive_node import PrimitiveNode
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.recording.failure import Failure, Rejection, as_failure
from skillc_runtime.recording.reasons import FailedCallContext
from skillc_runtime.world.state.labels.labelled import LabelledFact, LabelledValue
from skillc_runtime.world.state.python_calls import FOREIGN_ERRORS


def make_call_failure(failure: Failure | None, name: str, source: Position, skill: str) -> Failure:
    """Return the failure of a body as that of its call, with the name of the skill if the failure has none."""
    if failure is None:
        return Failure(kind="body", message=f"{name} failed", source=source, skill=skill)
    return failure if failure.skill else structs.replace(failure, skill=skill)


def reject_implementation(implementation: Implementation, failure: Failure, ran: bool = False) -> Rejection:
    """Return the rejection of an implementation that could not start, or that has run and failed."""
    return Rejection(
        implementation=implementation.name,
        stage="run" if ran else "start",
        reason=failure.message,
        source=failure.source or implementation.source,
        failure=failure,
    )


class CallNode(WaitingCall):
    """Tries the implementations in rank order; each start evaluates the arguments and infers parameters again.

    `rejected` are the implementations rejected at the last start, with reasons; `activation` is the chosen one.
    """

    __slots__ = (
        "_arguments",
        "_build",
        "_facts",
        "_path",
        "_remaining",
        "_state_at_start",
        "activation",
        "rejected",
    )

    def __init__(self, context: TreeContext, node: tree.Call, scope: LexicalScope, build: BuildNode) -> None:
        super().__init__(context, node, scope)
        self.activation: Activation | None = None
        self.rejected: list[Rejection] = []
        self._arguments: Frame = {}
        self._facts: tuple[LabelledFact, ...] | None = None
        self._build = build

    def foresee(self, freed: Holders) -> Status:
        context, scope = self.context, self.scope
        arguments, numbered = evaluate_arguments(self.node, scope, context.state), context.last_id
        foreseen = (
            foresee_implementation(context, self.skill, each, arguments, self, scope, self._build, freed)
            for each in self._ranked
        )
        try:
            return next((status for status in foreseen if status is not None), FAILURE)
        finally:
            context.last_id = numbered  # nodes that are not started have no number

    def on_start(self) -> Status:
        self.rejected = []
        self.activation = None
        self.children = ()
        self._arguments, self._facts = {}, None
        return super().on_start()

    def begin(self) -> Status:
        """Choose an implementation and start it, of those that have not run yet; or wait for what others use."""
        self._state_at_start = self.context.state
        self._arguments = evaluate_arguments(self.node, self.scope, self.context.state)
        self.rejected = [each for each in self.rejected if each.stage == "run"]
        passed = find_used(self.skill, self._arguments)
        if self.must_wait_for(passed):
            self.choices = [passed]
            return self.queue_up()
        ran = {each.implementation for each in self.rejected}
        self._remaining = iter([each for each in self._ranked if each.name not in ran])
        return self._try_next(self._remaining)

    def tick(self) -> Status:
        if self.waits:
            return super().tick()
        activation = self.activation
        assert activation is not None, "tick before start"
        failure = self._check_running(activation)
        if failure is not None:
            self._record_facts()
            activation.body.halt(failure.message)
            return self._end_failed(activation, failure)
        status = self._path.tick_leaf()
        return RUNNING if status is RUNNING else self.on_child_ended(self._path.propagate(status))

    def active_leaf(self) -> Node:
        """Return the active leaf of the body, or this node if holds or `verify` lines must be checked in each tick."""
        activation = self.activation
        return self if activation is None or activation.needs_monitoring else activation.body.active_leaf()

    def on_child_ended(self, status: Status) -> Status:
        activation = self.activation
        if status is RUNNING or activation is None:
            return status
        if status is not SUCCESS:
            if _refused(activation.body):
                self._note_refusal(activation)
                self.context.refresh_state()
                return self._try_next(self._remaining)
            return self._end_failed(activation, self._read_failure(activation.body))
        try:
            failure = activation.apply_results()
            if failure is None:
                self._assign_output(activation)
        except FOREIGN_ERRORS as error:  # a node is the boundary: it reports and fails
            failure = make_error(error, self.source, self.skill.name)
        if failure is not None:
            return self._end_failed(activation, failure)
        activation.release_locks()
        if self.scope.failures is not None:
            self.scope.failures.forget_call(self.skill.name, self._arguments)
        return self.succeed()

    def stop(self, reason: str) -> None:
        super().stop(reason)
        if self.activation is not None:
            self.context.broken_calls.append(self.activation.broken("halted"))

    def remains_satisfied(self) -> bool:
        return self.status is SUCCESS and (self.activation is None or self.activation.posts_hold())

    @property
    def _ranked(self) -> tuple[Implementation, ...]:
        return ranked_implementations(self.context.library, self.node.skill, self.node.implementation)

    def _try_next(self, implementations: Iterator[Implementation]) -> Status:
        self.choices = []
        for implementation in implementations:
            activation = self._activate(implementation)
            if isinstance(activation, Rejection):
                self.rejected.append(activation)
                if activation.stage not in ("run", "lock"):
                    self._remember_failure(activation.implementation, as_failure(activation, self.skill.name))
                continue
            status = self._start(activation)
            if status is not None:
                return status
        if self.choices:
            self.activation = None
            return self.queue_up()
        failure = combine_rejections(self.skill.name, self.rejected, self.source)
        world = self.context.cell.world
        return self.fail_unstarted(lead_with_withdrawal(failure, self._ranked, self._arguments, world))

    def _activate(self, implementation: Implementation) -> Activation | Rejection:
        try:
            bound = bind_unlocked(self.context, self.skill, implementation, self._arguments, self, self.scope)
            if isinstance(bound, Rejection):
                return bound
            activation = activate(self.context, self.skill, bound, self, self.scope, self._build)
            if isinstance(activation, Rejection) and activation.stage == "lock":
                every = (bound.bindings, *({**bound.bindings, **each} for each in bound.others))
                self.choices += [find_used(self.skill, each) for each in every]
                return activation
            for note in bound.notes:
                self.context.note(note, self.id, self.source)
            return activation
        except FOREIGN_ERRORS as error:  # the other implementations are tried
            return reject_implementation(implementation, make_error(error, self.source))

    def _start(self, activation: Activation) -> Status | None:
        """Start the body; return None if it refused to start and the next implementation is to be tried."""
        self.is_queued, self.activation, self.children = False, activation, (activation.body,)
        activation.body.parent = self
        self._path = ActivePath(activation.body)
        self.name = f"{self.skill.name}[{activation.implementation.name}]"
        self._emit_choice(activation)
        status = self._path.start()
        if status is RUNNING:
            return RUNNING
        if _refused(activation.body):
            self._note_refusal(activation)
            return None
        return self.on_child_ended(status)

    def _note_refusal(self, activation: Activation) -> None:
        """Reject an implementation whose body has refused to start."""
        self.context.locks.step_back(self, self.scope.calls)
        failure = self._read_failure(activation.body)
        self._remember_failure(activation.implementation.name, failure)
        self.rejected.append(reject_implementation(activation.implementation, failure))

    def _end_failed(self, activation: Activation, failure: Failure) -> Status:
        """Undo and release everything, then try the next implementation if the skill has `fallback`."""
        self._record_facts()
        if isinstance(activation.body, PrimitiveNode):
            activation.body.undo_now()
        self.context.broken_calls.append(activation.broken("failed"))
        self._remember_failure(activation.implementation.name, failure)
        if not self.skill.fallback:
            activation.release_locks()
            return self.fail(failure)
        self.context.locks.step_back(self, self.scope.calls)
        self.context.refresh_state()
        self.rejected.append(reject_implementation(activation.implementation, failure, ran=True))
        self._facts = None
        return self._try_next(self._remaining)

    def _remember_failure(self, implementation: str, failure: Failure) -> None:
        """Record a failure for later attempts."""
        if self.scope.failures is not None:
            state, writes = self._state_at_start, self.context.cell.world.ledger.count
            self.scope.failures.add(self.skill.name, self._arguments, implementation, state, failure, writes)

    def _check_running(self, activation: Activation) -> Failure | None:
        """Check the holds if the state is new, and the `verify` lines in each tick; return the failure, if any."""
        try:
            failure = activation.check_holds() if self.context.state is not activation.holds_checked_in else None
            return failure or (activation.check_properties() if activation.implementation.verify else None)
        except FOREIGN_ERRORS as error:  # a node is the boundary: it reports, halts and fails
            return make_error(error, self.source, self.skill.name)

    def _assign_output(self, activation: Activation) -> None:
        if self.node.out is not None:
            self.scope.frame[self.node.out] = activation.frame[activation.outputs[0]]

    def _read_failure(self, body: Node) -> Failure:
        return make_call_failure(body.failure, self.name, self.source, self.skill.name)

    def describe_call(self) -> FailedCallContext:
        self._record_facts()
        return make_failure_context(self.skill, self._arguments, self.rejected, self._facts or (), self.context)

    def describe_outputs(self) -> dict[str, LabelledValue]:
        return {} if self.activation is None else label_outputs(self.activation, self.context)

    def _record_facts(self) -> None:
        """Record the facts that the conditions read, once per failure, before undoing changes them."""
        if self.context.emit is not None and self._facts is None:
            self._facts = collect_facts_at_failure(self._ranked, self.activation, self._arguments, self.context.state)

    def _emit_choice(self, activation: Activation) -> None:
        if self.context.emit is not None:
            body = EnclosingBody(self, self.scope, self.context)
            event = make_choice_event(
                self.id, self.node, activation, self._arguments, self.rejected, body, self.context
            )
            self.context.emit(event)


def _refused(body: Node) -> bool:
    """Whether a body is a primitive that has refused to start."""
    return isinstance(body, PrimitiveNode) and body.refused_to_start
