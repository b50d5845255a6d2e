"""One run of one implementation: its frame, locks, holds, body and effects."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Literal, cast

from skillc_model.skills import Implementation, Outcome, Post, Skill
from skillc_runtime.execution.selection.arguments import check_value
from skillc_runtime.execution.selection.binding import BoundImplementation, describe_unmet_condition
from skillc_runtime.execution.success_facts import BrokenCall
from skillc_runtime.execution.tree.calls.inverse_changes import inverse_changes
from skillc_runtime.execution.tree.calls.withdrawn_facts import lead_with_stop
from skillc_runtime.execution.tree.context import TreeContext
from skillc_runtime.execution.tree.lexical_scope import Frame
from skillc_runtime.execution.tree.node import Node
from skillc_runtime.execution.tree.nodes.primitive_node import PrimitiveNode
from skillc_runtime.execution.tree.sensing import (
    drop_sensed_changes,
    explain_change_not_sensed,
    explain_not_sensed,
    explain_outcome_not_sensed,
)
from skillc_runtime.execution.tree.verify_monitor import find_violation, monitored_properties
from skillc_runtime.recording.failure import Failure, FailureKind
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.effects import changes_of, find_unmet
from skillc_runtime.world.eval.explain import explain
from skillc_runtime.world.eval.expressions import value_of
from skillc_runtime.world.state.changes import Change
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState


class Activation:
    """An implementation that runs for a call; the call owns the locks. `body` is the node, initially not started.

    `holds_checked_in` is the last snapshot in which all holds were true; they are not evaluated in it again.
    """

    __slots__ = (
        "_context",
        "_holder",
        "_state_at_start",
        "_writes_at_start",
        "body",
        "bound",
        "frame",
        "holds_checked_in",
        "implementation",
        "skill",
    )

    def __init__(
        self, context: TreeContext, skill: Skill, bound: BoundImplementation, holder: object, body: Node, writes: int
    ) -> None:
        self.bound = bound
        self.implementation = bound.implementation
        self.skill = skill
        self.frame: Frame = bound.bindings
        self.body = body
        self.holds_checked_in: WorldState = context.state
        self._state_at_start, self._writes_at_start = context.state, writes
        self._context = context
        self._holder = holder

    def check_holds(self) -> Failure | None:
        """Return the failure of the first hold that is false in this tick's state, or None if all are true."""
        state = self._context.state
        for hold in self.implementation.hold:
            if not evaluate(hold.condition, state, self.frame):
                message = describe_unmet_condition(self.implementation, hold, "hold", self.frame, state)
                failure = Failure(kind="hold", message=message, source=hold.source, skill=self.skill.name)
                return lead_with_stop(failure, hold.condition, self.frame, self._context.cell.world)
        self.holds_checked_in = state
        return None

    @property
    def needs_monitoring(self) -> bool:
        """Whether holds or `verify` lines must be checked in each tick."""
        return bool(self.implementation.hold) or bool(monitored_properties(self.implementation))

    def check_properties(self) -> Failure | None:
        """Return the failure of the first `verify` line that is violated now, if any."""
        context = self._context
        return find_violation(self.implementation, context.cell, context.library.vocabulary, context.state, self.frame)

    def apply_results(self) -> Failure | None:
        """Read a primitive's outputs, write its posts and check the results of the body; return the failure."""
        self._context.refresh_state()
        if isinstance(self.body, PrimitiveNode):
            problem = self._read_outputs(self.body.outputs) or self._write_outcome(self.body)
            if problem is not None:
                return problem
            self._write_posts(self.body)
        return self._compute_outputs() or self._check_outputs() or self._check_posts() or self._check_outcomes()

    def release_locks(self) -> None:
        """Release the locks of the call."""
        self._context.locks.release(self._holder)

    def broken(self, status: Literal["failed", "halted"]) -> BrokenCall:
        """Return what is remembered of this run, once it has ended without success and all is undone."""
        named = frozenset(each for each in self.frame.values() if isinstance(each, str))
        return BrokenCall(status, self._writes_at_start, self._context.cell.world.ledger.count, named)

    def posts_hold(self) -> bool:
        """Whether all posts are true in this tick's state."""
        return posts_hold(self.implementation, self._context.state, self.frame)

    def find_true_outcomes(self) -> tuple[Outcome, ...]:
        """Return the outcomes that are true in this tick's state."""
        state = self._context.state
        return tuple(each for each in self.skill.outcomes if evaluate(each.condition, state, self.frame))

    @property
    def outputs(self) -> tuple[str, ...]:
        """The names of the output parameters."""
        return tuple(parameter.name for parameter in self.implementation.parameters if parameter.direction == "out")

    def _read_outputs(self, outputs: Mapping[str, object]) -> Failure | None:
        """Copy the primitive's outputs to the frame; return the failure of the first invalid one, if any."""
        for parameter in self.implementation.parameters:
            if parameter.direction == "out" and parameter.name in outputs:
                value = cast("Value", outputs[parameter.name])
                problem = check_value(parameter, value, self._context.state)
                if problem is not None:
                    return self._failure("error", f"output `{parameter.name}` {problem}")
                self.frame[parameter.name] = value
        return None

    def _compute_outputs(self) -> Failure | None:
        """Write what the implementation says of outputs to the frame; return the failure of the first invalid one."""
        parameters = {parameter.name: parameter for parameter in self.implementation.parameters}
        for each in self.implementation.outputs:
            value = value_of(each.value, self._context.state, self.frame)
            problem = check_value(parameters[each.name], value, self._context.state)
            if problem is not None:
                return self._failure("error", f"output `{each.name}` {problem}")
            self.frame[each.name] = value
        return None

    def _write_outcome(self, body: PrimitiveNode) -> Failure | None:
        """Write what an outcome says that a primitive has sensed; return the failure if it may not come."""
        sensed = body.done_by
        if sensed is None or not sensed.outcome:
            return None
        outcome = self.skill.find_outcome(sensed.outcome)
        if outcome is None or outcome.label not in sensed.outcomes:
            may = ", ".join(f"`{each}`" for each in sensed.outcomes) or "nothing"
            return self._failure("post", f"{self.skill.name} ended with `{sensed.outcome}`, where only {may} may come")
        changes = changes_of(outcome.effects, self._context.state, self.frame, self._state_at_start)
        self._context.cell.world.commit(changes, self.skill.name, sensed.outcome_evidence)
        self._context.refresh_state()
        return None

    def _write_posts(self, body: PrimitiveNode) -> None:
        effects = tuple(e for post in self.implementation.post if not post.sensed for e in post.effects)
        before = self._context.state
        changes = changes_of(effects, before, self.frame, self._state_at_start)
        assumed = drop_sensed_changes(changes, self._context.cell.world, self._writes_at_start)
        if assumed:
            self._context.write_assumed(assumed, self.skill.name)
        if changes:
            start, after = before if assumed == changes else self._state_at_start, self._context.state
            body.undo_posts = partial(_undo_posts, self._context, self.skill.name, changes, start, after)

    def _check_outputs(self) -> Failure | None:
        missing = [name for name in self.outputs if name not in self.frame]
        if not missing:
            return None
        return self._failure("body", f"{self.skill.name} succeeded without assigning `{missing[0]}`")

    def _failure(self, kind: FailureKind, message: str) -> Failure:
        return Failure(kind=kind, message=message, source=self.implementation.source, skill=self.skill.name)

    def _check_posts(self) -> Failure | None:
        state = self._context.state
        for post in self.implementation.post:
            if not evaluate(post.condition, state, self.frame):
                message = describe_unmet_condition(self.implementation, post, "post", self.frame, state)
                return Failure(kind="post", message=message, source=post.source, skill=self.skill.name)
            unmet = self._find_unmet(post)
            if unmet is not None:
                return unmet
            if post.sensed:
                world, writes = self._context.cell.world, self._writes_at_start
                reason = explain_not_sensed(post, world, self.frame, writes)
                reason = reason or explain_change_not_sensed(post, world, self.frame, self._state_at_start, writes)
                if reason is not None:
                    message = f"{self.skill.name}: {reason}"
                    return Failure(kind="post", message=message, source=post.source, skill=self.skill.name)
        return None

    def _find_unmet(self, post: Post | Outcome) -> Failure | None:
        """Return the failure if an effect on many, or on a number, is not so."""
        state = self._context.state
        unmet = find_unmet(post.effects, state, self.frame, self._state_at_start)
        if unmet is None:
            return None
        why = explain(unmet[0], state, unmet[1], self._context.library.vocabulary)
        message = f"`{post.text}` is not so in the end: {why}"
        return Failure(kind="post", message=message, source=post.source, skill=self.skill.name)

    def _check_outcomes(self) -> Failure | None:
        """Return the failure if not exactly one outcome has come true, or if nothing has sensed that it has."""
        if not self.skill.outcomes:
            return None
        true = self.find_true_outcomes()
        if len(true) != 1:
            found = " and ".join(f"`{each.label}`" for each in true) or "none of its outcomes"
            return self._failure("post", f"{self.skill.name} succeeded, and {found} came true, where one has to")
        if (unmet := self._find_unmet(true[0])) is not None:
            return unmet
        # a compound has acted on what its steps have sensed: its outcome also says what it has done
        since = self._state_at_start, self._writes_at_start
        primitive = isinstance(self.body, PrimitiveNode)
        reason = explain_outcome_not_sensed(true[0], self._context.cell.world, self.frame, *since, wholly=primitive)
        return None if reason is None else self._failure("post", f"{self.skill.name}: {reason}")


def posts_hold(implementation: Implementation, state: WorldState, frame: Frame) -> bool:
    """Whether all posts of an implementation are true."""
    return all(evaluate(post.achieved, state, frame) for post in implementation.post)


def _undo_posts(
    context: TreeContext, skill: str, changes: tuple[Change, ...], before: WorldState, after: WorldState
) -> None:
    context.refresh_state()
    inverse = inverse_changes(changes, before, after, context.state)
    if inverse:
        context.write_assumed(inverse, f"{skill} undone")
