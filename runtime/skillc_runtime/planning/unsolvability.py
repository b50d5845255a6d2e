"""Explains why there is no plan: which parts of the goal are unreachable, and which conditions of skills block them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import msgspec

from skillc_model.conditions import Condition
from skillc_model.pddl.domain import Action, GuardMeaning, Meaning
from skillc_model.pddl.formulas import (
    FALSE,
    TRUE,
    Atom,
    Change,
    Conjunction,
    Disjunction,
    Formula,
    conjunction,
    conjuncts,
)
from skillc_model.read_write import terms_read
from skillc_runtime.cancellation import Cancelled, CancelToken, cancelling, limit_current
from skillc_runtime.planning.change_text import ChangeText, describe_class, describe_unused_skills
from skillc_runtime.planning.formula_text import FormulaFormatter
from skillc_runtime.planning.goal_conflicts import GoalConflict, GoalConflicts
from skillc_runtime.planning.nearest_changes import NearestChanges
from skillc_runtime.planning.partial_bindings import PartialBindings, unify
from skillc_runtime.planning.plan import Excluded
from skillc_runtime.planning.problem.neighbourhood import AbstractionSize
from skillc_runtime.planning.problem.pose import PosedProblem, pose_problem
from skillc_runtime.planning.search.grounding import Grounding
from skillc_runtime.world.eval.explain import explain
from skillc_runtime.world.eval.obstacles import RelationObstacle
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.world_state import WorldState

MAX_DEPTH = 4
MAX_LISTED = 3
NOTHING = "which nothing fulfils"
EXPLANATION_S = 5.0
"""The time limit for an explanation; a large scene may need more, and then gets a general one."""


class UnsolvabilityReason(msgspec.Struct, frozen=True):
    """Why there is no plan: how the parts of the goal depend on conditions, and what keeps these from holding.

    `causes` are the nearest changes after which the goal may be reached; empty if none was found. `obstacles` are what
    reasoners say of them.
    """

    why: str
    causes: tuple[str, ...] = ()
    obstacles: tuple[RelationObstacle, ...] = ()


def pose_to_explain(
    posed: PosedProblem, state: WorldState, goal: Condition, without: Sequence[Excluded], size: AbstractionSize | None
) -> PosedProblem:
    """Return a problem without a plan with the individuals that no helpful step involves: without a plan none does.

    Where that would leave out others, it is returned as it is.
    """
    complete = pose_problem(posed.library, state, goal, without, size, keep_unneeded=True)
    return posed if complete.narrowed else complete


def explain_unsolvable(posed: PosedProblem, goal: Condition, state: WorldState) -> UnsolvabilityReason:
    """Return why a problem has no plan, as far as reachability without deletions shows."""
    reasons: tuple[str, ...] = ()
    causes: tuple[str, ...] = ()
    obstacles: tuple[RelationObstacle, ...] = ()
    limit = limit_current(EXPLANATION_S)
    try:
        with cancelling(limit):
            explanation = _Explanation(posed, state, limit)
            reasons = tuple(explanation.explain_goal(goal))
            causes, obstacles = explanation.find_causes(goal)
    except Cancelled:
        reasons = reasons or ("no sequence of skills reaches the goal; the scene is too large to say why",)
    undecided = (f"not decided: {each}" for each in posed.undecided[:MAX_LISTED])
    notes = (*reasons, *_describe_left_out(posed), *undecided)
    return UnsolvabilityReason("; ".join(dict.fromkeys(notes)), causes, obstacles)


class _Explanation:
    """Explains why a goal is out of reach; what individuals lack to take part in skills is collected while it does."""

    def __init__(self, posed: PosedProblem, state: WorldState, limit: CancelToken) -> None:
        self._posed, self._state, self._limit = posed, state, limit
        self._domain, self._objects = posed.problem.domain, posed.problem.objects
        self._iris = posed.problem.names
        skipped = any(each.kind == "skills" for each in posed.restricted)
        self._no_skill = "no plannable skill" if skipped else "no skill"
        self._nothing = "no plannable skill" if skipped else "nothing"
        self._formatter = FormulaFormatter(posed.problem, posed.library)
        self._grounding = Grounding(posed.problem, limit)
        self._grounding.explore()
        self._partial = PartialBindings(posed.problem, self._grounding, limit)
        self._unfit: list[str] = []

    def explain_goal(self, condition: Condition) -> Iterator[str]:
        """Yield an explanation for each part of the goal that cannot be reached."""
        goal = self._grounding.goal()
        if goal == FALSE:
            yield f"{self._no_skill} can change this: {explain(condition, self._state, {}, self._state.vocabulary)}"
            return
        parts = conjuncts(goal)
        lost = [part for part in parts if not self._grounding.is_possible(part)]
        yield from (self._explain_part(part, MAX_DEPTH) for part in lost)
        if not lost:
            conflicts = GoalConflicts(self._posed.problem, self._posed.library, self._state, self._limit)
            yield self._describe_conflict(conflicts.find(parts))

    def _describe_conflict(self, conflict: GoalConflict) -> str:
        *others, last = (f"`{self._formatter.format(each)}`" for each in conflict.parts)
        if not others:
            return f"{last} cannot be reached: each step towards it can be done, but not without undoing another"
        once = "the first is" if len(others) == 1 else "the others are"
        why = f": once {once}, {conflict.why}" if conflict.why else ""
        return f"{', '.join(others)} and {last} cannot be reached together{why}"

    def find_causes(self, condition: Condition) -> tuple[tuple[str, ...], tuple[RelationObstacle, ...]]:
        """Return what a person may change, and what reasoners say, after the goal has been explained."""
        problem, library = self._posed.problem, self._posed.library
        nearest = NearestChanges(problem, self._state, self._grounding, self._limit)
        reachable = self._grounding.is_possible(self._grounding.goal())
        text = ChangeText(problem, library, self._state)
        found = text.describe(nearest.find_blocking() if reachable else nearest.find())
        if not found and not reachable:
            unused = describe_unused_skills(terms_read(condition), problem, library)
            found = tuple(self._unfit) or tuple(unused)
        return tuple(dict.fromkeys(found))[:MAX_LISTED], tuple(dict.fromkeys(text.obstacles))

    def _explain_part(self, part: Formula, depth: int) -> str:
        if isinstance(part, Disjunction) and len(part.parts) > 1:
            listed = (self._explain_part(each, depth) for each in part.parts[:MAX_LISTED])
            more = len(part.parts) - MAX_LISTED
            return "; and ".join(dict.fromkeys(listed)) + (f"; and {more} more cases" if more > 0 else "")
        if isinstance(part, Conjunction):
            lost = (each for each in part.parts if not self._grounding.is_possible(each))
            return "; ".join(self._explain_part(each, depth) for each in lost)
        shown = self._formatter.format(part)
        actions = self._domain.actions if isinstance(part, Atom) and depth else ()
        reasons = [reason for action in actions for reason in self._explain_action(action, part, depth)]
        if not reasons:
            mistyped = [each for action in actions for each in self._find_mistyped(action, part)]
            least = min(map(len, mistyped), default=0)
            self._unfit += [text for each in mistyped if len(each) == least for text in each]
            return f"{self._nothing} makes `{shown}` true"
        return f"`{shown}` cannot be reached: " + "; ".join(dict.fromkeys(reasons))

    def _explain_action(self, action: Action, wanted: Formula, depth: int) -> Iterator[str]:
        """Yield why an action cannot make an atom true, for each of its effects on that atom."""
        for change in action.effects:
            start = unify(change.atom, wanted, action) if change.positive else None
            if start is not None and self._fits_types(action, start):
                yield f"{action.skill} {self._describe_need(action, change, start, depth)}"

    def _fits_types(self, action: Action, values: dict[str, str]) -> bool:
        return not any(self._partial.mistyped(action, values))

    def _find_mistyped(self, action: Action, wanted: Formula) -> Iterator[tuple[str, ...]]:
        """Yield which individuals of an atom are not of the classes that an action with this effect takes."""
        labels = dict(zip((each.name for each in action.parameters), action.binds, strict=True))
        for change in action.effects:
            start = unify(change.atom, wanted, action) if change.positive else None
            if start is not None:
                yield tuple(
                    f"{describe_class(name, self._posed.problem, self._state)}, and {action.skill} needs a "
                    f"{self._formatter.format_type(cls)} as `{labels[variable]}`"
                    for variable, name, cls in self._partial.mistyped(action, start)
                )

    def _describe_need(self, action: Action, change: Change, start: dict[str, str], depth: int) -> str:
        """Return what an action needs: an object of a class, or the first condition that cannot hold with others.

        That may be the condition of the change, if it changes something only where another thing is so.
        """
        for parameter, label in zip(action.parameters, action.binds, strict=True):
            if not self._domain.of_type(self._objects, parameter.type):
                wanted = self._formatter.format_type(parameter.type)
                self._unfit.append(f"there is no {wanted}, which {action.skill} needs as `{label}`")
                return f"needs a {wanted} as `{label}`, and there is none"
        conditions = conjuncts(conjunction((action.precondition, action.hold)))
        names = {each.name: f"`{label}`" for each, label in zip(action.parameters, action.binds, strict=True)}
        for count, condition in enumerate(conditions):
            if next(self._grounding.find_bindings(action, conditions[: count + 1], start), None) is None:
                shown = self._formatter.format(condition, {**names, **self._short_names(start)})
                left = self._grounding.find_bindings(action, conditions[:count], start)
                return f"needs {shown}, {self._explain_condition(condition, left, depth)}"
        if change.condition == TRUE:
            return f"needs all of its conditions at once, {NOTHING}"
        only = self._formatter.format(change.condition, {**names, **self._short_names(start)})
        return f"changes that only where {only}, {NOTHING}"

    def _short_names(self, values: dict[str, str]) -> dict[str, str]:
        return {variable: self._formatter.format_object(name) for variable, name in values.items()}

    def _explain_condition(self, condition: Formula, left: Iterator[dict[str, str]], depth: int) -> str:
        """Return why a condition fails; detailed if the conditions before it leave few bindings of its variables."""
        if not isinstance(condition, Atom):
            return NOTHING
        predicate, wanted = self._domain.predicate[condition.predicate], set[tuple[str, ...]]()
        most = 1 if predicate.changes else MAX_LISTED
        for values in left:
            wanted.add(tuple(values.get(term, term) for term in condition.terms))
            if len(wanted) > most:
                return NOTHING
        if predicate.changes:
            return "and " + "".join(self._explain_part(Atom(predicate.name, terms), depth - 1) for terms in wanted)
        reasons = "; ".join(filter(None, (self._explain_static(predicate.meaning, terms) for terms in sorted(wanted))))
        return f"{NOTHING}: {reasons}" if reasons else NOTHING

    def _explain_static(self, meaning: Meaning, terms: tuple[str, ...]) -> str:
        """Return why a static condition does not hold for these objects; empty if there is no explanation."""
        if not isinstance(meaning, GuardMeaning):
            return ""
        individuals = [self._iris.get(term) for term in terms]
        bindings = {name: iri for name, iri in zip(meaning.variables, individuals, strict=True) if iri is not None}
        try:
            return explain(meaning.condition, self._state, bindings, self._state.vocabulary)
        except EvaluationError as reason:
            return str(reason)


def _describe_left_out(posed: PosedProblem) -> Iterator[str]:
    """Yield the skills and steps that may help but were left out, with the reasons."""
    for each in posed.restricted:
        if each.kind == "skills":
            yield f"{', '.join(each.what)} is left out of planning: {each.why}"
        else:
            yield f"planned without {', '.join(each.what)}: {each.why}"
