"""Infers the parameters of one implementation from its preconditions, with notes and rejections for users."""

from __future__ import annotations

from collections.abc import Mapping, Sequence, Set

import msgspec

from skillc_model.skills import Implementation, Parameter, Requirement
from skillc_model.traversal import free_variables
from skillc_rdf.vocabulary.types import ClassType, Vocabulary
from skillc_runtime.recording.failure import Rejection
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.explain import explain
from skillc_runtime.world.eval.inference import Ambiguous, Binding, Inferred, NoneFound, infer
from skillc_runtime.world.eval.near_misses import NearMiss
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState

MAX_NEAR_MISSES = 3
"""How many near misses are listed in a rejection."""


class InferredParameters(msgspec.Struct, frozen=True):
    """Individuals by parameter; `alternatives` are those that `infer any` did not choose, which `notes` list.

    `others` are the other solutions, in IRI order.
    """

    bindings: Binding
    alternatives: Mapping[str, tuple[str, ...]] = msgspec.field(default_factory=dict)
    notes: tuple[str, ...] = ()
    others: tuple[Binding, ...] = ()


def infer_parameters(
    implementation: Implementation, bindings: Mapping[str, Value], state: WorldState
) -> InferredParameters | Rejection:
    """Infer the parameters that were not passed from all preconditions."""
    wanted = _parameters_to_infer(implementation, bindings.keys())
    match infer(wanted, implementation.pre, bindings, state):
        case Inferred(bindings=found, others=others):
            return InferredParameters(
                found, _find_alternatives(found, others), _make_notes(found, others, state.vocabulary), others
            )
        case NoneFound() as none:
            return _reject_none_found(implementation, wanted, none, state.vocabulary)
        case Ambiguous(candidates=candidates):
            return _reject_ambiguous(implementation, wanted, candidates, state.vocabulary)


def infer_fixed_parameters(
    implementation: Implementation,
    requirements: Sequence[Requirement],
    bindings: dict[str, Value],
    passed: Set[str],
    state: WorldState,
) -> dict[str, Value] | Rejection:
    """Return the bindings with those inferred parameters for which the requirements leave one individual.

    No skill changes whether `requirements` hold. A rejection says which of them no individual can meet.
    """
    wanted = _parameters_to_infer(implementation, bindings.keys() | passed)
    for parameter in wanted:
        if isinstance(parameter.type, ClassType) and not state.instances(parameter.type.iri):
            cls = state.vocabulary.short(parameter.type.iri)
            return _reject(
                implementation, [parameter], None, f"`{parameter.name}`: there is no {cls} in the world model"
            )
    names = {parameter.name for parameter in wanted}
    usable = [r for r in requirements if free_variables(r.condition) <= bindings.keys() | names]
    decided = [r for r in usable if names.isdisjoint(free_variables(r.condition))]
    false = next((r for r in decided if not evaluate(r.condition, state, bindings)), None)
    if false is not None:
        return _reject(implementation, [], false, explain(false.condition, state, bindings, state.vocabulary))
    linked = [p for p in wanted if any(p.name in free_variables(r.condition) for r in usable)]
    match infer(linked, usable, bindings, state):
        case Inferred(bindings=found, others=others):
            return bindings | _common_bindings((found, *others))
        case Ambiguous(candidates=candidates):
            settled = _fully_decided_parameters(linked, implementation.pre, usable)
            if any(len({answer[p.name] for answer in candidates}) > 1 and not p.any_ for p in settled):
                return _reject_ambiguous(implementation, settled, candidates, state.vocabulary)
            return bindings | _common_bindings(candidates)
        case NoneFound() as none:
            return _reject_none_found(implementation, linked, none, state.vocabulary)


def _parameters_to_infer(implementation: Implementation, known: Set[str]) -> list[Parameter]:
    return [p for p in implementation.parameters if p.direction == "infer" and p.name not in known]


def _fully_decided_parameters(
    wanted: Sequence[Parameter], requirements: Sequence[Requirement], decided: Sequence[Requirement]
) -> list[Parameter]:
    """Return the parameters that are linked, directly or through others, to `decided` requirements only.

    Inference finds the same individuals for them at any later time.
    """
    names = {parameter.name for parameter in wanted}
    open_ = set[str]().union(*(free_variables(r.condition) & names for r in requirements if r not in decided))
    groups = [free_variables(requirement.condition) & names for requirement in requirements]
    while reached := {name for group in groups if not open_.isdisjoint(group) for name in group} - open_:
        open_ |= reached
    return [parameter for parameter in wanted if parameter.name not in open_]


def _common_bindings(answers: Sequence[Binding]) -> dict[str, Value]:
    """Return the bindings on which all answers agree."""
    first = answers[0]
    return {name: iri for name, iri in first.items() if all(answer[name] == iri for answer in answers)}


def _find_alternatives(found: Binding, others: Sequence[Binding]) -> dict[str, tuple[str, ...]]:
    """Return the other individuals for each parameter that has alternatives."""
    each = {name: tuple(dict.fromkeys(other[name] for other in others if other[name] != found[name])) for name in found}
    return {name: alternatives for name, alternatives in each.items() if alternatives}


def _make_notes(found: Binding, others: Sequence[Binding], vocabulary: Vocabulary) -> tuple[str, ...]:
    return tuple(
        f"`{name}` is {vocabulary.short(found[name])}, the first of "
        f"{_format_candidates(name, (found, *others), vocabulary)}"
        for name in found
        if any(other[name] != found[name] for other in others)
    )


def _reject(
    implementation: Implementation, wanted: Sequence[Parameter], requirement: Requirement | None, reason: str
) -> Rejection:
    about = f"no answer for `{requirement.text}`: " if requirement is not None else ""
    source = requirement.source if requirement is not None else wanted[0].source
    return Rejection(
        implementation=implementation.name, stage="inference" if wanted else "pre", reason=about + reason, source=source
    )


def _reject_none_found(
    implementation: Implementation, wanted: Sequence[Parameter], none: NoneFound, vocabulary: Vocabulary
) -> Rejection:
    """Reject with the requirement that left no answer and, if that says more, the nearest misses."""
    near = [miss for miss in none.nearest if miss.reason != none.reason]
    near.sort(key=lambda miss: miss.requirement is not none.requirement)
    shown = "; or ".join(_format_near_miss(miss, none.requirement, vocabulary) for miss in near[:MAX_NEAR_MISSES])
    reason = f"{none.reason}; nearest: {shown}" if shown else none.reason
    return _reject(implementation, wanted, none.requirement, reason)


def _format_near_miss(miss: NearMiss, shown: Requirement | None, vocabulary: Vocabulary) -> str:
    who = ", ".join(f"{name} = {vocabulary.short(miss.bindings[name])}" for name in miss.about)
    other = f"for `{miss.requirement.text}`, " if miss.requirement is not None and miss.requirement is not shown else ""
    return f"{who}, but {other}{miss.reason}"


def _reject_ambiguous(
    implementation: Implementation, wanted: Sequence[Parameter], answers: Sequence[Binding], vocabulary: Vocabulary
) -> Rejection:
    open_ = [p for p in wanted if len({answer[p.name] for answer in answers}) > 1 and not p.any_]
    each = [f"`{p.name}` may be {_format_candidates(p.name, answers, vocabulary)}" for p in open_]
    reason = f"{'; '.join(each)}: pass it, or accept any with `infer any {open_[0].name}`"
    return Rejection(implementation=implementation.name, stage="inference", reason=reason, source=open_[0].source)


def _format_candidates(name: str, answers: Sequence[Binding], vocabulary: Vocabulary) -> str:
    return ", ".join(dict.fromkeys(vocabulary.short(answer[name]) for answer in answers))
