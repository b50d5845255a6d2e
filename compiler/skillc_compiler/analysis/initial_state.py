"""What is known when the body of an implementation begins."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from skillc_compiler.analysis.binding import class_of, definite_effects
from skillc_compiler.analysis.knowledge.alias_types import AliasTypes
from skillc_compiler.analysis.knowledge.assume import assume
from skillc_compiler.analysis.knowledge.axioms import CanonicalAxioms
from skillc_compiler.analysis.knowledge.havoc import havoc
from skillc_compiler.analysis.knowledge.state import IndividualTerm, State
from skillc_compiler.analysis.knowledge.writes import Write, normalise_each
from skillc_compiler.program.typed import Implementation, Parameter, Requirement, Task
from skillc_compiler.program.types import Thing as ThingType
from skillc_model.conditions import Compare, Condition, ForEach, Given, Holds, Individual, Literal, Not, Same, Variable
from skillc_model.rewriting import constant_number
from skillc_model.traversal import conjuncts
from skillc_rdf.vocabulary.types import THING


def requirements_of(implementation: Implementation, kind: str) -> tuple[Requirement, ...]:
    """Return the conditions of a kind, those of the description first."""
    both = (*implementation.skill.requirements, *implementation.requirements)
    return tuple(each for each in both if each.kind == kind)


def declare_names(types: AliasTypes, of: Implementation | Task) -> None:
    """Record the class of each parameter and of each `let` that names an individual."""
    types.classes.update({p.name: class_of(p) for p in of.parameters})
    if isinstance(of, Implementation):
        for let in of.lets:
            if isinstance(let.value.type, ThingType):
                types.classes[let.name.text] = let.value.type.cls or THING


def initial_state(types: AliasTypes, implementation: Implementation, writes: Iterable[Write] = ()) -> State:
    """Return the state at the start: preconditions and holds hold, numbers are in range, `let` names are aliases.

    `writes` are those of the body.
    """
    state = parameter_state(implementation).replace(unchanged=frozenset(_effects_on_many(implementation)))
    for requirement in _assumed_requirements(implementation):
        state = assume(types, state, requirement.condition.meaning) or state
    for excluded in (*_kept_apart(types, implementation), *_kept_open(types, implementation, frozenset(writes))):
        state = assume(types, state, excluded) or state
    return state


def _effects_on_many(implementation: Implementation) -> Iterator[ForEach]:
    """Yield the effects on many that an implementation promises, in their one form."""
    for _, effect in definite_effects(requirements_of(implementation, "post")):
        if isinstance(effect, ForEach):
            yield normalise_each(effect)


def _kept_apart(types: AliasTypes, implementation: Implementation) -> Iterable[Condition]:
    """Yield that two names differ, for each two that a post relates by an irreflexive relation.

    If they were the same, the post could never hold.
    """
    for post in requirements_of(implementation, "post"):
        for fact in conjuncts(post.condition.meaning):
            match fact:
                case Holds(Variable() as left, relation, Variable() as right) if _is_irreflexive(types, relation):
                    yield Not(Same(left, right))


def _kept_open(types: AliasTypes, implementation: Implementation, writes: frozenset[Write]) -> Iterable[Condition]:
    """Yield that no chain leads to where a link begins that a post makes, if it could not be broken by the body before.

    If one led there, it and the link would lead back to where they begin, so that the post could never hold.
    """
    for post in requirements_of(implementation, "post"):
        for back in _chains_back(types.axioms, conjuncts(post.condition.meaning)):
            if back in havoc(types, State(facts={back: True}), writes).facts:
                yield Not(back)


def _chains_back(axioms: CanonicalAxioms, facts: Iterable[Condition]) -> Iterator[Condition]:
    """Yield the chains with which links between two names would lead back to where they begin."""
    for fact in facts:
        match fact:
            case Holds(Variable() as left, named, Variable() as right):
                relation, turned = axioms.canonical.get(named, (named, False))
                start, end = (right, left) if turned else (left, right)
                ways = [each for each in axioms.implied.get(relation, ()) if each[0] in axioms.acyclic]
                chains = (each for each in ways if each[0] in axioms.transitive)
                yield from (Holds(start, above, end) if back else Holds(end, above, start) for above, back in chains)


def _is_irreflexive(types: AliasTypes, relation: str) -> bool:
    return types.axioms.canonical.get(relation, (relation, False))[0] in types.axioms.irreflexive


def can_start(types: AliasTypes, implementation: Implementation) -> bool:
    """Whether the preconditions and holds do not contradict each other."""
    state: State | None = parameter_state(implementation)
    for requirement in _assumed_requirements(implementation):
        state = assume(types, state, requirement.condition.meaning) if state is not None else None
    return state is not None


def _assumed_requirements(implementation: Implementation) -> tuple[Requirement, ...]:
    return (*requirements_of(implementation, "pre"), *requirements_of(implementation, "hold"))


def parameter_state(implementation: Implementation) -> State:
    """Return what is known without the conditions: numbers are in range, `let` names are aliases."""
    return State(facts=dict(_ranges(implementation.parameters)), aliases=_let_aliases(implementation))


def _let_aliases(implementation: Implementation) -> dict[str, IndividualTerm]:
    found: dict[str, IndividualTerm] = {}
    for let in implementation.lets:
        meaning = let.value.meaning
        if isinstance(meaning, Variable | Individual):
            found[let.name.text] = found.get(meaning.name, meaning) if isinstance(meaning, Variable) else meaning
    return found


def _ranges(parameters: Iterable[Parameter]) -> Iterable[tuple[Condition, bool]]:
    for parameter in parameters:
        if not parameter.may_be_unset:
            yield Given(parameter.name), True
        for bound, sign in ((parameter.low, ">="), (parameter.high, "<=")):
            limit = constant_number(bound.meaning) if bound is not None else None
            if limit is not None and not parameter.may_be_unset:
                yield Compare(Variable(parameter.name), sign, Literal(limit)), True  # type: ignore[arg-type]
