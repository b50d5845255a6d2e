"""The inferred parameters of one implementation, with what a person should read about them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence, Set
from dataclasses import dataclass, field

from skillc_compiler.library.reading import free_variables
from skillc_compiler.library.skills import Implementation, Parameter, Requirement
from skillc_compiler.library.vocabulary import ClassType, Vocabulary
from skillc_runtime.trace.failure import Rejected
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.explain import explain
from skillc_runtime.world.eval.inference import Ambiguous, Binding, Found, NoneFound, infer
from skillc_runtime.world.eval.nearest import NearMiss
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState

NEAREST = 3
"""So many near misses are named in words."""


@dataclass(frozen=True, slots=True)
class Inferred:
    """Individuals by parameter name; `others` are those that `infer any` passed over, `notes` say so in words."""

    bindings: Binding
    others: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    notes: tuple[str, ...] = ()


def infer_parameters(
    implementation: Implementation, bindings: Mapping[str, Value], state: WorldState
) -> Inferred | Rejected:
    """Find the inferred parameters that nobody passed, from all preconditions."""
    wanted = _wanted(implementation, bindings.keys())
    match infer(wanted, implementation.pre, bindings, state):
        case Found(bindings=found, others=others):
            return Inferred(found, _others(found, others), _passed_over(found, others, state.vocabulary))
        case NoneFound() as none:
            return _none_found(implementation, wanted, none, state.vocabulary)
        case Ambiguous(candidates=candidates):
            return _ambiguous(implementation, wanted, candidates, state.vocabulary)


def infer_fixed(
    implementation: Implementation,
    requirements: Sequence[Requirement],
    bindings: dict[str, Value],
    passed: Set[str],
    state: WorldState,
) -> dict[str, Value] | Rejected:
    """Return the bindings with those inferred parameters that the requirements leave no choice for.

    `requirements` hold for ever or never. A rejection says which of them no individuals can meet.
    """
    wanted = _wanted(implementation, bindings.keys() | passed)
    for parameter in wanted:
        if isinstance(parameter.type, ClassType) and not state.instances(parameter.type.iri):
            cls = state.vocabulary.short(parameter.type.iri)
            return _none(implementation, [parameter], None, f"`{parameter.name}`: there is no {cls} in the world model")
    names = {parameter.name for parameter in wanted}
    usable = [r for r in requirements if free_variables(r.condition) <= bindings.keys() | names]
    decided = [r for r in usable if names.isdisjoint(free_variables(r.condition))]
    false = next((r for r in decided if not evaluate(r.condition, state, bindings)), None)
    if false is not None:
        return _none(implementation, [], false, explain(false.condition, state, bindings, state.vocabulary))
    linked = [p for p in wanted if any(p.name in free_variables(r.condition) for r in usable)]
    match infer(linked, usable, bindings, state):
        case Found(bindings=found, others=others):
            return bindings | _agreed((found, *others))
        case Ambiguous(candidates=candidates):
            settled = _settled(linked, implementation.pre, usable)
            if any(len({answer[p.name] for answer in candidates}) > 1 and not p.any_ for p in settled):
                return _ambiguous(implementation, settled, candidates, state.vocabulary)
            return bindings | _agreed(candidates)
        case NoneFound() as none:
            return _none_found(implementation, linked, none, state.vocabulary)


def _wanted(implementation: Implementation, known: Set[str]) -> list[Parameter]:
    return [p for p in implementation.parameters if p.direction == "infer" and p.name not in known]


def _settled(
    wanted: Sequence[Parameter], requirements: Sequence[Requirement], decided: Sequence[Requirement]
) -> list[Parameter]:
    """Return the parameters that only those requirements speak of, themselves or through others, that are decided.

    What may be found for them will be the same at any later time.
    """
    names = {parameter.name for parameter in wanted}
    open_ = set[str]().union(*(free_variables(r.condition) & names for r in requirements if r not in decided))
    groups = [free_variables(requirement.condition) & names for requirement in requirements]
    while reached := {name for group in groups if not open_.isdisjoint(group) for name in group} - open_:
        open_ |= reached
    return [parameter for parameter in wanted if parameter.name not in open_]


def _agreed(answers: Sequence[Binding]) -> dict[str, Value]:
    """Return what all answers have in common."""
    first = answers[0]
    return {name: iri for name, iri in first.items() if all(answer[name] == iri for answer in answers)}


def _others(found: Binding, others: Sequence[Binding]) -> dict[str, tuple[str, ...]]:
    """Return what else each parameter might have been, without those that have no alternative."""
    each = {name: tuple(dict.fromkeys(other[name] for other in others if other[name] != found[name])) for name in found}
    return {name: alternatives for name, alternatives in each.items() if alternatives}


def _passed_over(found: Binding, others: Sequence[Binding], vocabulary: Vocabulary) -> tuple[str, ...]:
    return tuple(
        f"`{name}` is {vocabulary.short(found[name])}, the first of {_listed(name, (found, *others), vocabulary)}"
        for name in found
        if any(other[name] != found[name] for other in others)
    )


def _none(
    implementation: Implementation, wanted: Sequence[Parameter], requirement: Requirement | None, reason: str
) -> Rejected:
    about = f"no answer for `{requirement.text}`: " if requirement is not None else ""
    source = requirement.source if requirement is not None else wanted[0].source
    return Rejected(
        implementation=implementation.name, stage="inference" if wanted else "pre", reason=about + reason, source=source
    )


def _none_found(
    implementation: Implementation, wanted: Sequence[Parameter], none: NoneFound, vocabulary: Vocabulary
) -> Rejected:
    """Say what left none and, where that says more, what came nearest: first what meets all the rest."""
    near = [miss for miss in none.nearest if miss.reason != none.reason]
    near.sort(key=lambda miss: miss.requirement is not none.requirement)
    shown = "; or ".join(_near(miss, none.requirement, vocabulary) for miss in near[:NEAREST])
    reason = f"{none.reason}; nearest: {shown}" if shown else none.reason
    return _none(implementation, wanted, none.requirement, reason)


def _near(miss: NearMiss, told: Requirement | None, vocabulary: Vocabulary) -> str:
    who = ", ".join(f"{name} = {vocabulary.short(miss.bindings[name])}" for name in miss.about)
    other = f"for `{miss.requirement.text}`, " if miss.requirement is not None and miss.requirement is not told else ""
    return f"{who}, but {other}{miss.reason}"


def _ambiguous(
    implementation: Implementation, wanted: Sequence[Parameter], answers: Sequence[Binding], vocabulary: Vocabulary
) -> Rejected:
    open_ = [p for p in wanted if len({answer[p.name] for answer in answers}) > 1 and not p.any_]
    each = [f"`{p.name}` may be {_listed(p.name, answers, vocabulary)}" for p in open_]
    reason = f"{'; '.join(each)}: pass it, or let any do with `infer any {open_[0].name}`"
    return Rejected(implementation=implementation.name, stage="inference", reason=reason, source=open_[0].source)


def _listed(name: str, answers: Sequence[Binding], vocabulary: Vocabulary) -> str:
    return ", ".join(dict.fromkeys(vocabulary.short(answer[name]) for answer in answers))
