"""One start of one implementation: its frame, its locks, its holds, its body, and what it leaves behind."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import TypeAlias, assert_never, cast

from skillc_compiler.library import tree
from skillc_compiler.library.skills import Compound, Implementation, Primitive, Skill
from skillc_runtime.selection.arguments import problem_with
from skillc_runtime.selection.fit import Fitted, broken_text, first_broken
from skillc_runtime.selection.python import PrimitiveError, fitting_class
from skillc_runtime.trace.failure import Failure, FailureKind, Rejected, Stage
from skillc_runtime.tree.context import Context
from skillc_runtime.tree.enclosing import Enclosing, Frame
from skillc_runtime.tree.node import Node
from skillc_runtime.tree.primitive_node import PrimitiveNode
from skillc_runtime.tree.restore import reverse_of
from skillc_runtime.tree.sensing import not_sensed, unsensed
from skillc_runtime.tree.verifying import violation, watched
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.effects import changes_of
from skillc_runtime.world.eval.expressions import value_of
from skillc_runtime.world.state.changes import Change
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState

Build: TypeAlias = Callable[[tree.Node, Context, Enclosing], Node]


class Activation:
    """An implementation that runs for a call, the holder of its locks. `body` is its node, not yet started.

    `checked` is the state in which the holds were last seen to hold: the same snapshot gives the same answer.
    """

    __slots__ = (
        "_before",
        "_begun",
        "_context",
        "_holder",
        "body",
        "checked",
        "fitted",
        "frame",
        "implementation",
        "skill",
    )

    def __init__(self, context: Context, skill: Skill, fitted: Fitted, holder: object, body: Node, begun: int) -> None:
        self.fitted = fitted
        self.implementation = fitted.implementation
        self.skill = skill
        self.frame: Frame = fitted.bindings
        self.body = body
        self.checked: WorldState = context.state
        self._before, self._begun = context.state, begun
        self._context = context
        self._holder = holder

    def broken_hold(self) -> Failure | None:
        """Check the holds in this tick's state; return the failure of the first that broke."""
        state = self._context.state
        for hold in self.implementation.hold:
            if not evaluate(hold.condition, state, self.frame):
                message = broken_text(self.implementation, hold, "hold", self.frame, state)
                return Failure(kind="hold", message=message, source=hold.source, skill=self.skill.name)
        self.checked = state
        return None

    @property
    def watchful(self) -> bool:
        """Whether something must be looked at in each tick."""
        return bool(self.implementation.hold) or bool(watched(self.implementation))

    def violation(self) -> Failure | None:
        """Return what of the implementation's `verify` lines is violated now."""
        context = self._context
        return violation(self.implementation, context.cell, context.library.vocabulary, context.state, self.frame)

    def conclude(self) -> Failure | None:
        """After the body succeeded: take a primitive's outputs, write its posts, check all; return what is wrong."""
        self._context.refresh()
        if isinstance(self.body, PrimitiveNode):
            problem = self._take_outputs(self.body.outputs)
            if problem is not None:
                return problem
            self._write_posts(self.body)
        return self._missing_output() or self._broken_post()

    def close(self) -> None:
        """Give the locks back."""
        self._context.locks.give_back(self._holder)

    def posts_hold(self) -> bool:
        """Whether all posts hold in this tick's state."""
        return all(evaluate(post.condition, self._context.state, self.frame) for post in self.implementation.post)

    @property
    def outputs(self) -> tuple[str, ...]:
        """The names of the output parameters."""
        return tuple(parameter.name for parameter in self.implementation.parameters if parameter.direction == "out")

    def _take_outputs(self, outputs: Mapping[str, object]) -> Failure | None:
        """Take what the primitive assigned, each value of the type that its parameter has."""
        for parameter in self.implementation.parameters:
            if parameter.direction == "out" and parameter.name in outputs:
                value = cast("Value", outputs[parameter.name])
                problem = problem_with(parameter, value, self._context.state)
                if problem is not None:
                    return self._failure("error", f"output `{parameter.name}` {problem}")
                self.frame[parameter.name] = value
        return None

    def _write_posts(self, body: PrimitiveNode) -> None:
        effects = tuple(e for post in self.implementation.post if not post.sensed for e in post.effects)
        before = self._context.state
        changes = changes_of(effects, before, self.frame)
        assumed = unsensed(changes, self._context.cell.world, self._begun)
        if assumed:
            self._context.assume(assumed, self.skill.name)
        if changes:
            start = before if assumed == changes else self._before
            body.restore = partial(_restore, self._context, self.skill.name, changes, start, self._context.state)

    def _missing_output(self) -> Failure | None:
        missing = [name for name in self.outputs if name not in self.frame]
        if not missing:
            return None
        return self._failure("body", f"{self.skill.name} succeeded without assigning `{missing[0]}`")

    def _failure(self, kind: FailureKind, message: str) -> Failure:
        return Failure(kind=kind, message=message, source=self.implementation.source, skill=self.skill.name)

    def _broken_post(self) -> Failure | None:
        state = self._context.state
        for post in self.implementation.post:
            if not evaluate(post.condition, state, self.frame):
                message = broken_text(self.implementation, post, "post", self.frame, state)
                return Failure(kind="post", message=message, source=post.source, skill=self.skill.name)
            why = not_sensed(post, self._context.cell.world, self.frame, self._begun) if post.sensed else None
            if why is not None:
                message = f"{self.skill.name}: {why}"
                return Failure(kind="post", message=message, source=post.source, skill=self.skill.name)
        return None


def activate(
    context: Context, skill: Skill, fitted: Fitted, holder: object, enclosing: Enclosing, build: Build
) -> Activation | Rejected:
    """Check the holds, take the locks, compute the lets, build the body; a rejection leaves nothing behind.

    EvaluationError from a hold or a let.
    """
    implementation, frame = fitted.implementation, fitted.bindings
    rejected = first_broken(implementation, implementation.hold, "hold", frame, context.state)
    rejected = rejected or _take_locks(context, skill, fitted, holder, enclosing)
    if rejected is not None:
        return rejected
    try:
        for let in implementation.lets:
            frame[let.name] = value_of(let.value, context.state, frame)
        body = _body(context, skill, fitted, holder, enclosing, build)
    except PrimitiveError as error:
        context.locks.give_back(holder)
        return _rejected(implementation, "start", str(error))
    except Exception:
        context.locks.give_back(holder)
        raise
    return Activation(context, skill, fitted, holder, body, context.cell.world.ledger.count)


def _take_locks(
    context: Context, skill: Skill, fitted: Fitted, holder: object, enclosing: Enclosing
) -> Rejected | None:
    devices = [str(fitted.bindings[name]) for name in skill.uses if name in fitted.bindings]
    taken = context.locks.take(devices, holder, enclosing.calls)
    if taken is None:
        return None
    reason = f"{context.library.vocabulary.short(taken)} is in use by another skill"
    return _rejected(fitted.implementation, "lock", reason)


def _body(context: Context, skill: Skill, fitted: Fitted, holder: object, enclosing: Enclosing, build: Build) -> Node:
    implementation, frame = fitted.implementation, fitted.bindings
    match implementation.body:
        case Compound(node=node):
            calls, begun = (*enclosing.calls, holder), context.cell.world.ledger.count
            return build(node, context, Enclosing(enclosing.undo, frame, implementation, calls, begun=begun))
        case Primitive(python=python):
            cls = fitting_class(python, implementation.parameters)
            names = [p.name for p in implementation.parameters if p.direction != "out"]
            make = partial(cls, context.cell, **{name: frame.get(name) for name in names})
            undo = enclosing.undo if skill.scoped else None
            return PrimitiveNode(context, implementation.source, python.partition(":")[2], make, undo)
        case _:
            assert_never(implementation.body)


def _restore(context: Context, skill: str, changes: tuple[Change, ...], before: WorldState, after: WorldState) -> None:
    context.refresh()
    reverse = reverse_of(changes, before, after, context.state)
    if reverse:
        context.assume(reverse, f"{skill} undone")


def _rejected(implementation: Implementation, stage: Stage, reason: str) -> Rejected:
    return Rejected(implementation=implementation.name, stage=stage, reason=reason, source=implementation.source)
