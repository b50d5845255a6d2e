"""What an author could add so that a finding goes away: it is tried before a message recommends it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import combinations

from msgspec import structs

from skillc_compiler.analysis.binding import call_requirements, class_of, fresh_variable
from skillc_compiler.analysis.effects.sayable import declare
from skillc_compiler.analysis.effects.universals import Assume, Universals
from skillc_compiler.analysis.effects.unnamed import find_taken, has_since
from skillc_compiler.analysis.exploration import Exploration
from skillc_compiler.analysis.findings import (
    Finding,
    Remedy,
    UndeclaredEffect,
    UnprovedPost,
    UnprovedPrecondition,
)
from skillc_compiler.analysis.initial_state import requirements_of
from skillc_compiler.analysis.knowledge.evaluate import evaluate
from skillc_compiler.analysis.paths import EndStates
from skillc_compiler.program.typed import Call, Implementation, TypedNode
from skillc_compiler.program.types import Thing
from skillc_compiler.program.walk import calls_in, nodes_in
from skillc_dsl import syntax as s
from skillc_model.conditions import (
    Adjust,
    Condition,
    Effect,
    Expression,
    ForEach,
    Holds,
    Variable,
    single_effect,
    wanted_by,
)
from skillc_model.rewriting import ALWAYS, substitute
from skillc_model.traversal import conjuncts, free_variables
from skillc_rdf.vocabulary.types import THING

MOST_STEPS = 200
"""The number of steps of a body that are explored again, whatever is found in it."""


@dataclass
class _Trials:
    """Explorations with remedies: the last one took so many `steps`, and so many are `left` for others."""

    assume: Assume
    steps: int
    left: int

    def may_make(self, count: int) -> bool:
        """Whether that many explorations are few enough."""
        return count * self.steps <= self.left

    def explore(self, remedy: Remedy) -> tuple[Exploration, EndStates]:
        """Explore the body with a remedy."""
        run, ends = self.assume(remedy)
        self.steps = run.steps
        self.left -= run.steps
        return run, ends

    def accepts(self, remedy: Remedy) -> bool:
        """Whether each success has what a `post some` says, done to what was there at the start."""
        run, ends = self.explore(remedy)
        unmet = any(isinstance(each, UnprovedPrecondition) for each in run.unproved_preconditions())
        said = remedy.some.effect if remedy.some is not None else ALWAYS
        return bool(ends.success) and not unmet and all(evaluate(run.types, each, said) for each in ends.success)

    def is_passed(self, remedy: Remedy, call: Call) -> bool:
        """Whether each success has what a remedy says, if what the call finds is passed to it."""
        run, ends = self.explore(remedy)
        unproved = (each for each in run.unproved_preconditions() if isinstance(each, UnprovedPrecondition))
        unmet = any(each.call.written is call.written for each in unproved)
        said = [each for each in remedy.after if not isinstance(each, ForEach | Adjust)]
        met = all(evaluate(run.types, state, each) for state in ends.success for each in said)
        return bool(ends.success) and not unmet and met

    def helps(self, remedy: Remedy, one: UnprovedPost | UnprovedPrecondition) -> bool:
        """Whether a finding goes away with a remedy."""
        run, ends = self.explore(remedy)
        if isinstance(one, UnprovedPost):
            meaning = one.post.condition.meaning
            return bool(ends.success) and all(evaluate(run.types, state, meaning) for state in ends.success)
        left = (each for each in run.unproved_preconditions() if isinstance(each, UnprovedPrecondition))
        return not any(each.call is one.call and each.requirement is one.requirement for each in left)


def add_remedies(
    run: Exploration, implementation: Implementation, found: Iterable[Finding], ends: EndStates, universals: Universals
) -> Iterator[Finding]:
    """Yield the findings, with a remedy where one is known to help."""
    trials = _Trials(universals.assume, run.steps, MOST_STEPS)
    for one in found:
        match one:
            case UnprovedPost(false=False, instead=None):
                yield structs.replace(one, remedy=_keep_apart(implementation, one, trials))
            case UnprovedPrecondition(condition=condition) if condition is not None:
                yield _require(run, implementation, one, condition, trials)
            case UndeclaredEffect(effect=effect):
                remedy = declare(implementation, one.call, effect, ends, universals) if effect is not None else None
                if remedy is None and effect is not None and _may_name(implementation, one.call, effect, trials):
                    remedy = _declare_found(run, implementation, one, wanted_by(single_effect(effect)), trials)
                is_sayable = one.possible is not None and has_since(run, implementation, "possible")
                possible = Remedy(possible=one.possible) if is_sayable else None
                yield structs.replace(one, remedy=remedy or possible)
            case _:
                yield one


def is_on_found(effect: Effect) -> bool:
    """Whether an effect is on something that a called skill finds at run time."""
    return not isinstance(effect, ForEach) and any("@" in name for name in free_variables(wanted_by(effect)))


def _may_name(implementation: Implementation, call: Call, effect: Effect, trials: _Trials) -> bool:
    """Whether a skill may have a name for what a call finds: not for what each of several rounds finds."""
    body = implementation.body
    nodes = nodes_in(body) if isinstance(body, TypedNode) else ()
    rounds = (each for each in nodes if isinstance(each.written, s.While | s.For) or _repeats(each))
    is_one = not any(inner is call for each in rounds for inner in calls_in(each))
    return is_one and is_on_found(effect) and trials.may_make(1)


def _repeats(node: TypedNode) -> bool:
    """Whether a round follows one that has succeeded."""
    return isinstance(node.written, s.Decorator) and node.written.row.on_success == "again"


def _keep_apart(implementation: Implementation, one: UnprovedPost, trials: _Trials) -> Remedy | None:
    """Return which parameters have to differ so that a postcondition holds."""
    apart = _pairs(implementation)
    return _with_fewest_apart(Remedy(apart=apart), one, trials) if apart and trials.may_make(1 + len(apart)) else None


def _require(
    run: Exploration, implementation: Implementation, one: UnprovedPrecondition, condition: Condition, trials: _Trials
) -> UnprovedPrecondition:
    """Return the finding with a precondition that is enough; incurable if none is, whatever differs."""
    required = _name(run, implementation, condition, is_post=False)
    if required is None or not trials.may_make(1):
        return one
    if trials.helps(required, one):
        return structs.replace(one, remedy=required)
    apart = _pairs(implementation)
    if apart and not trials.may_make(1 + len(apart)):
        return one
    remedy = _with_fewest_apart(structs.replace(required, apart=apart), one, trials) if apart else None
    return structs.replace(one, remedy=remedy, incurable=remedy is None)


def _with_fewest_apart(remedy: Remedy, one: UnprovedPost | UnprovedPrecondition, trials: _Trials) -> Remedy | None:
    """Return a remedy with as few parameters that differ as are enough; None if it does not help."""
    if not trials.helps(remedy, one):
        return None
    fewest = remedy
    for each in remedy.apart:
        fewer = structs.replace(fewest, apart=tuple(other for other in fewest.apart if other is not each))
        if trials.helps(fewer, one):
            fewest = fewer
    return fewest


def _declare_found(
    run: Exploration, implementation: Implementation, one: UndeclaredEffect, effect: Condition, trials: _Trials
) -> Remedy | None:
    """Return what declares an effect; what the call finds by itself is passed if nothing else could be meant then."""
    named = _name(run, implementation, effect, is_post=True)
    if named is None:
        return None
    again, ends = trials.explore(named)
    said = [each for each in named.after if not isinstance(each, ForEach | Adjust)]
    if ends.success and all(evaluate(again.types, state, each) for state in ends.success for each in said):
        return named
    taken = find_taken(run, implementation, one) if trials.may_make(1) else None
    if taken is not None:  # where it is not accepted, a parameter that is inferred and passed would not be either
        return taken if trials.accepts(taken) else None
    fresh = {name.rstrip("'"): _parameter_name(name) for name in free_variables(effect) if "@" in name}
    values, names = _values(one.call, fresh), {*(each.name for each in implementation.parameters), *fresh.values()}
    needed = (substitute(each.condition.meaning, values) for each in call_requirements(run.program, one.call, "pre"))
    about = (each for each in needed if {*fresh.values()} & free_variables(each) and free_variables(each) <= names)
    known = _known_before(implementation)
    before = dict.fromkeys((*named.before, *(each for each in about if each not in known)))
    passed = structs.replace(named, before=tuple(before), passed=tuple(fresh.values()), call=one.call)
    return passed if trials.may_make(1) and trials.is_passed(passed, one.call) else None


def _pairs(implementation: Implementation) -> tuple[tuple[str, str], ...]:
    """Return each two parameters that may be the same individual."""
    return tuple(combinations((each.name for each in implementation.parameters if isinstance(each.type, Thing)), 2))


def _name(run: Exploration, implementation: Implementation, condition: Condition, is_post: bool) -> Remedy | None:
    """Return what makes a condition sayable in the skill: parameters for what called skills find at run time."""
    own = {each.name: each for each in implementation.parameters}
    found = {name.rstrip("'"): name for name in free_variables(condition) if "@" in name}
    fresh = {name: _parameter_name(name) for name in found}
    if len(set(fresh.values())) < len(fresh) or any(
        name not in own and name not in found.values() for name in free_variables(condition)
    ):
        return None
    classes = {new: run.types.classes.get(name, THING) for name, new in fresh.items()}
    if THING in classes.values():  # what is found is a value, or may be anything
        return None
    if any(new in own and not run.types.vocabulary.is_a(class_of(own[new]), cls) for new, cls in classes.items()):
        return None
    said = substitute(condition, {found[name]: Variable(new) for name, new in fresh.items()})
    known = _known_before(implementation)
    links = dict.fromkeys(each for each in _links(run, implementation, fresh, own.keys()) if each not in known)
    parameters = tuple((new, cls) for new, cls in classes.items() if new not in own)
    if is_post:
        return Remedy(parameters, tuple(links), after=(said,))
    return Remedy(parameters, (*links, *((said,) if said not in known and said not in links else ())))


def _known_before(implementation: Implementation) -> set[Condition]:
    """Return the preconditions that a skill has, also those that `pre of` takes over."""
    required = (each.condition.meaning for each in requirements_of(implementation, "pre"))
    return {part for each in required for part in conjuncts(each)}


def _parameter_name(fresh: str) -> str:
    """Return the name of the parameter that the variable stands for, as in `Pick.robot@12:9`."""
    return fresh.partition("@")[0].rpartition(".")[2]


def _links(
    run: Exploration, implementation: Implementation, fresh: Mapping[str, str], own: Iterable[str]
) -> Iterator[Condition]:
    """Yield the relations by which called skills find these individuals, between names that the skill has or gets."""
    names = {*own, *fresh.values()}
    body = implementation.body
    for call in calls_in(body) if isinstance(body, TypedNode) else ():
        values = _values(call, fresh)
        asked = [each for each in (call.skill.requirements if call.skill else ()) if each.kind == "pre"]
        for fact in (fact for each in asked for fact in conjuncts(each.condition.meaning) if isinstance(fact, Holds)):
            said = substitute(fact, values)
            about = free_variables(said)
            if not run.types.is_computed(fact.relation) and about <= names and about & {*fresh.values()}:
                yield said


def _values(call: Call, fresh: Mapping[str, str]) -> dict[str, Expression]:
    """Return the values of a called skill's parameters, with new names for what it finds of these."""
    values: dict[str, Expression] = {each.name.text: each.value.meaning for each in call.values}
    for parameter in call.skill.parameters if call.skill else ():
        if parameter.name not in values:
            made = fresh_variable(call, parameter).name
            values[parameter.name] = Variable(fresh.get(made, made))
    return values
