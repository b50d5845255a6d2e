"""Why a call cannot start, or go on, that could before: somebody, or a device, has changed a fact that it needs."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from msgspec import structs

from skillc_model.conditions import And, Condition, Holds, Individual, PropertyOf, Variable
from skillc_model.skills import Implementation
from skillc_model.traversal import conjuncts, walk
from skillc_runtime.recording.failure import Failure
from skillc_runtime.world.eval.expressions import Bindings, iri_of
from skillc_runtime.world.state.facts import PropertyFact, RelationFact
from skillc_runtime.world.state.labels.labelled_text import format_fact
from skillc_runtime.world.state.labels.labelling import label_fact
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import DEVICE_STATE


def lead_with_withdrawal(
    failure: Failure, tried: Sequence[Implementation], arguments: Bindings, world: WorldModel
) -> Failure:
    """Return the failure of a call whose conditions do not hold, led by how this came about if the run saw it."""
    if failure.kind == "hold":
        holds = [hold.condition for each in tried for hold in each.hold]
        return lead_with_stop(failure, And(tuple(holds)), arguments, world)
    if not failure.is_unmet_need:
        return failure
    state = world.snapshot()
    for fact in _lost_facts(tried, arguments, world):
        write = world.deciding_write(fact)
        if write is not None and write.evidence not in (None, "assumed"):
            message = f"`{format_fact(label_fact(fact, state))}` does not hold any more: {write.origin}"
            return structs.replace(failure, kind="contradiction", message=message, detail=failure.message)
    return failure


def lead_with_stop(failure: Failure, hold: Condition, frame: Bindings, world: WorldModel) -> Failure:
    """Return the failure of a hold, led by why a device has stopped if the hold reads the state of one that has."""
    for read in walk(hold):
        match read:
            case PropertyOf(of=Variable() | Individual() as of, property=property_) if property_ == DEVICE_STATE:
                device = iri_of(of, frame)
            case _:
                continue
        if device is None or world.snapshot().value(device, DEVICE_STATE) != "Fault":
            continue
        stop = world.deciding_write(PropertyFact(device, DEVICE_STATE))
        if stop is not None and stop.evidence == "reported":
            return structs.replace(failure, message=stop.origin, detail=failure.message)
    return failure


def _lost_facts(tried: Sequence[Implementation], arguments: Bindings, world: WorldModel) -> Iterator[RelationFact]:
    """Yield the relations between known individuals that preconditions state and that do not hold."""
    needed = (requirement.condition for each in tried for requirement in each.pre)
    literals = (literal for condition in needed for literal in conjuncts(condition) if isinstance(literal, Holds))
    for literal in literals:
        subject, object_ = iri_of(literal.subject, arguments), iri_of(literal.object, arguments)
        if subject is None or object_ is None or world.snapshot().holds(subject, literal.relation, object_):
            continue
        yield RelationFact(subject, literal.relation, object_)
