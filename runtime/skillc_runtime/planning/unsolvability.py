"""Why there is no plan: what of the goal nothing can make true, and what the skills that could are missing."""

from __future__ import annotations

import time
from collections.abc import Iterator

from skillc_model.conditions import Condition
from skillc_model.pddl.domain import Action, GuardFact, Meaning
from skillc_model.pddl.formulas import FALSE, Atom, Conjunction, Disjunction, Formula, conjunction, conjuncts
from skillc_runtime.planning.formula_text import FormulaFormatter
from skillc_runtime.planning.problem.pose import Posed
from skillc_runtime.planning.search.grounding import Grounding, GroundingTimeout
from skillc_runtime.world.eval.explain import explain
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.world_state import WorldState

DEPTH = 4
LISTED = 3
LONGEST_S = 5.0
"""Finding out why takes no longer than this; of a large scene it may not be found out."""


def explain_unsolvable(posed: Posed, goal: Condition, state: WorldState) -> str:
    """Say why a problem without a plan has none, as far as reachability without deletions can tell."""
    try:
        reasons = tuple(_Diagnosis(posed, state).reasons(goal))
    except GroundingTimeout:
        reasons = ("no sequence of skills reaches the goal; the scene is too large to say why",)
    notes = [*reasons, *_left_out(posed), *_undecided(posed)]
    return "; ".join(dict.fromkeys(notes))


class _Diagnosis:
    def __init__(self, posed: Posed, state: WorldState) -> None:
        self._domain, self._objects = posed.problem.domain, posed.problem.objects
        self._state, self._names = state, posed.problem.names
        skipped = any(each.kind == "skills" for each in posed.restricted)
        self._none = "no skill that is planned with" if skipped else "no skill"
        self._nothing = "no skill that is planned with" if skipped else "nothing"
        self._words = FormulaFormatter(posed.problem, posed.library)
        self._grounding = Grounding(posed.problem, time.monotonic() + LONGEST_S)
        self._grounding.explore()

    def reasons(self, condition: Condition) -> Iterator[str]:
        """Yield what is wrong with each part of the goal that cannot be reached."""
        goal = self._grounding.goal()
        if goal == FALSE:
            yield f"{self._none} can change this: {explain(condition, self._state, {}, self._state.vocabulary)}"
            return
        lost = [part for part in conjuncts(goal) if not self._grounding.possible(part)]
        yield from (self._unreachable(part, DEPTH) for part in lost)
        if not lost:
            yield "each part of the goal can be reached, but not all of them together"

    def _unreachable(self, part: Formula, depth: int) -> str:
        if isinstance(part, Disjunction) and len(part.parts) > 1:
            listed = (self._unreachable(each, depth) for each in part.parts[:LISTED])
            more = len(part.parts) - LISTED
            return "; and ".join(dict.fromkeys(listed)) + (f"; and {more} more cases" if more > 0 else "")
        if isinstance(part, Conjunction):
            lost = (each for each in part.parts if not self._grounding.possible(each))
            return "; ".join(self._unreachable(each, depth) for each in lost)
        shown = self._words.formula(part)
        actions = self._domain.actions if isinstance(part, Atom) and depth else ()
        reasons = [reason for action in actions for reason in self._failures(action, part, depth)]
        if not reasons:
            return f"{self._nothing} makes `{shown}` true"
        return f"`{shown}` cannot be reached: " + "; ".join(dict.fromkeys(reasons))

    def _failures(self, action: Action, wanted: Formula, depth: int) -> Iterator[str]:
        """Yield why an action cannot make an atom true, for each of its effects that would."""
        for change in action.effects:
            start = _unified(change.atom, wanted, action) if change.positive else None
            if start is not None and self._typed(action, start):
                yield f"{action.skill} {self._missing(action, start, depth)}"

    def _typed(self, action: Action, values: dict[str, str]) -> bool:
        types = {each.name: each.type for each in self._objects}
        wanted = {each.name: each.type for each in action.parameters}
        return all(self._domain.is_a(types[name], wanted[variable]) for variable, name in values.items())

    def _missing(self, action: Action, start: dict[str, str], depth: int) -> str:
        """Say what an action lacks: a thing of a class, or the first condition that fails beside those before it."""
        for parameter, label in zip(action.parameters, action.binds, strict=True):
            if not self._domain.of_type(self._objects, parameter.type):
                return f"needs a {self._words.type_(parameter.type)} as `{label}`, and there is none"
        conditions = conjuncts(conjunction((action.precondition, action.hold)))
        names = {each.name: f"`{label}`" for each, label in zip(action.parameters, action.binds, strict=True)}
        for count, condition in enumerate(conditions):
            if next(self._grounding.fitting(action, conditions[: count + 1], start), None) is None:
                shown = self._words.formula(condition, {**names, **self._shown(start)})
                left = self._grounding.fitting(action, conditions[:count], start)
                return f"needs {shown}, {self._because(condition, left, depth)}"
        raise AssertionError(f"{action.name} can make this true")

    def _shown(self, values: dict[str, str]) -> dict[str, str]:
        return {variable: self._words.object_(name) for variable, name in values.items()}

    def _because(self, condition: Formula, left: Iterator[dict[str, str]], depth: int) -> str:
        """Say why a condition fails, if the conditions before it left few choices of the objects it is about."""
        if not isinstance(condition, Atom):
            return "which nothing fulfils"
        predicate, wanted = self._domain.predicate[condition.predicate], set[tuple[str, ...]]()
        most = 1 if predicate.changes else LISTED
        for values in left:
            wanted.add(tuple(values.get(term, term) for term in condition.terms))
            if len(wanted) > most:
                return "which nothing fulfils"
        if predicate.changes:
            return "and " + "".join(self._unreachable(Atom(predicate.name, terms), depth - 1) for terms in wanted)
        reasons = "; ".join(filter(None, (self._settled(predicate.meaning, terms) for terms in sorted(wanted))))
        return f"which nothing fulfils: {reasons}" if reasons else "which nothing fulfils"

    def _settled(self, meaning: Meaning, terms: tuple[str, ...]) -> str:
        """Say why a condition that nothing changes does not hold of these objects, empty where it cannot be said."""
        if not isinstance(meaning, GuardFact):
            return ""
        individuals = [self._names.get(term) for term in terms]
        bindings = {name: iri for name, iri in zip(meaning.variables, individuals, strict=True) if iri is not None}
        try:
            return explain(meaning.condition, self._state, bindings, self._state.vocabulary)
        except EvaluationError as reason:
            return str(reason)


def _unified(atom: Atom, wanted: Formula, action: Action) -> dict[str, str] | None:
    """Return the objects of an action's variables that make an effect the wanted atom, None when none do."""
    if not isinstance(wanted, Atom) or atom.predicate != wanted.predicate:
        return None
    parameters = {each.name for each in action.parameters}
    values: dict[str, str] = {}
    for term, name in zip(atom.terms, wanted.terms, strict=True):
        if values.setdefault(term, name) != name or (term not in parameters and term != name):
            return None
    return {term: name for term, name in values.items() if term in parameters}


def _left_out(posed: Posed) -> Iterator[str]:
    """Yield the skills and steps that might help but are not planned with, and why."""
    for each in posed.restricted:
        if each.kind == "skills":
            yield f"{', '.join(each.what)} is left out of planning: {each.why}"
        else:
            yield f"planned without {', '.join(each.what)}: {each.why}"


def _undecided(posed: Posed) -> Iterator[str]:
    yield from (f"not decided: {each}" for each in posed.undecided[:LISTED])
