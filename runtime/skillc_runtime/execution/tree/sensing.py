"""Facts that were sensed since a skill started; only these count as measurements."""

from __future__ import annotations

from collections.abc import Sequence

from skillc_model.conditions import Condition
from skillc_model.skills import Outcome, Post
from skillc_model.traversal import conjuncts
from skillc_runtime.execution.tree.lexical_scope import Frame
from skillc_runtime.world.eval.bindings import Bindings
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.effects import list_changed
from skillc_runtime.world.eval.grounds import Ground, find_grounds
from skillc_runtime.world.state.changes import AddRelation, Change, RemoveRelation, SetProperty
from skillc_runtime.world.state.evidence import DecidingWrite, stated_fact
from skillc_runtime.world.state.labels.labelled_text import format_fact
from skillc_runtime.world.state.labels.labelling import label_fact
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.values import are_equal
from skillc_runtime.world.state.world_state import WorldState


def drop_sensed_changes(changes: Sequence[Change], world: WorldModel, writes_before: int) -> tuple[Change, ...]:
    """Return the changes without those that devices have reported since write number `writes_before`.

    A sensed fact keeps its evidence: it must not be written again as an assumption.
    """
    return tuple(change for change in changes if not _is_sensed(change, world, writes_before))


def explain_not_sensed(post: Post, world: WorldModel, frame: Frame, writes_before: int) -> str | None:
    """Explain why a post that is `sensed`, and holds, was not measured since a write; None if it was."""
    reasons = (_explain_literal(post, each, world, frame, writes_before) for each in conjuncts(post.condition))
    return next((each for each in reasons if each is not None), None)


def explain_outcome_not_sensed(
    outcome: Outcome, world: WorldModel, frame: Frame, before: WorldState, writes_before: int, *, wholly: bool
) -> str | None:
    """Explain why an outcome that came true was not measured since a write, in the state `before`; None if it was.

    What is known already need not be sensed again. Unless `wholly`, it is enough that one of its literals was.
    """
    literals = tuple(conjuncts(outcome.condition))
    reasons = [_explain_literal(outcome, each, world, frame, writes_before) for each in literals]
    if not wholly and None in reasons:
        return None
    new = (why for each, why in zip(literals, reasons, strict=True) if not evaluate(each, before, frame))
    return next((each for each in new if each is not None), None)


def explain_change_not_sensed(
    post: Post, world: WorldModel, frame: Frame, before: WorldState, writes_before: int
) -> str | None:
    """Explain why the numbers that a `sensed` post changes were not measured since a write; None if they were."""
    changed = list_changed(post.effects, frame, before)
    reasons = (_explain_literal(post, each, world, bound, writes_before) for each, bound in changed)
    return next((each for each in reasons if each is not None), None)


def _explain_literal(
    post: Post | Outcome, literal: Condition, world: WorldModel, frame: Bindings, writes_before: int
) -> str | None:
    found = find_grounds(literal, world, frame)
    assumed = next((ground for ground in found if ground.is_assumed), None)
    if assumed is not None:
        return f"`{post.text}` must be sensed, but {_describe_ground(assumed, world)}"
    if not any(_is_sensed_since(ground.write, writes_before) for ground in found):
        old = f": {'; '.join(_describe_ground(ground, world) for ground in found)}" if found else ""
        return f"`{post.text}` must be sensed, and nothing has sensed it since the skill started{old}"
    return None


def _is_sensed(change: Change, world: WorldModel, writes_before: int) -> bool:
    state, fact = world.snapshot(), stated_fact(change)
    match change:
        case AddRelation(subject, relation, object_) | RemoveRelation(subject, relation, object_):
            holds = state.holds(subject, relation, object_) is isinstance(change, AddRelation)
        case SetProperty(individual, property_, value):
            present = state.value(individual, property_)
            holds = present is not None and are_equal(present, value)
        case _:
            return False
    return holds and fact is not None and _is_sensed_since(world.deciding_write(fact), writes_before)


def _is_sensed_since(established: DecidingWrite | None, writes_before: int) -> bool:
    if established is None or established.number <= writes_before:
        return False
    return established.evidence in ("sensed", "reported", "idealised")


def _describe_ground(ground: Ground, world: WorldModel) -> str:
    """Return a fact with its evidence, for example "`lab:A contain lab:B` was assumed by Place"."""
    fact = format_fact(label_fact(ground.fact, world.snapshot()))
    known = ground.write
    if known is None or known.evidence is None:
        return f"`{fact}` was so before"
    by = f" by {known.origin}" if known.origin else ""
    return f"`{fact}` was {known.evidence}{by}"
