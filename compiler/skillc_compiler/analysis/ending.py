"""What the ends of a body say: posts that do not hold, effects nobody declared, what was left behind on failure."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.analysis.binding import changes
from skillc_compiler.analysis.findings import Finding, NeverAssigned, Undeclared, Unproved, Unreleased
from skillc_compiler.analysis.learning import learned
from skillc_compiler.analysis.opening import requirements_of
from skillc_compiler.analysis.run import Effected, Run
from skillc_compiler.analysis.sorts import Sorts
from skillc_compiler.analysis.state import State
from skillc_compiler.analysis.summaries import calls_in
from skillc_compiler.analysis.trail import Ends, Way, Ways, length
from skillc_compiler.analysis.truth import truth
from skillc_compiler.analysis.writes import Related, Valued, Write, condition_of, write_of
from skillc_compiler.analysis.writing import applied
from skillc_compiler.program.typed import Body, Call, Implementation, Requirement, TypedNode
from skillc_compiler.program.walk import within
from skillc_dsl import syntax as s
from skillc_model.conditions import (
    Arithmetic,
    Condition,
    Effect,
    Exists,
    Forall,
    Holds,
    Invoke,
    IsA,
    Not,
    PropertyOf,
    Same,
    Variable,
)
from skillc_model.reading import free_variables, walk


def findings(run: Run, implementation: Implementation, start: State, ends: Ends) -> Iterator[Finding]:
    """Yield what is wrong with the states in which an implementation ends.

    Where what is promised is not established, an effect that nobody promised has the same cause as a rule.
    """
    unassigned: set[str] = set()
    unproved: list[Finding] = []
    for parameter in implementation.parameters:
        ways = [way for state, way in ends.success.items() if parameter.name not in state.assigned]
        if parameter.direction == "out" and ways:
            unassigned.add(parameter.name)
            yield NeverAssigned(implementation, parameter, min(ways, key=length))
    for post in requirements_of(implementation, "post"):
        if unassigned.isdisjoint(free_variables(post.clause.meaning)):
            unproved += _unproved(run, implementation, post, ends.success)
    yield from unproved
    declared = _declared(run, implementation, start)
    effects = {one.effect: one for one in reversed(run.effects.values())}
    for one in effects.values():
        condition = effected(one.effect)
        if condition is not None:
            if not unproved:
                yield from _undeclared(run, implementation, one, condition, (start, declared), ends.success)
            yield from _unreleased(run, one, condition, start, ends)


def leaks(run: Run, implementation: Implementation, start: State, ends: Ends) -> frozenset[Write]:
    """Return the writes that a successful run may leave behind beside what the description says."""
    declared = _declared(run, implementation, start)
    found = set()
    for write in run.summaries.anything(implementation):
        condition = condition_of(write) if isinstance(write, Related | Valued) else None
        if condition is None or any(_is_made_up(part) for part in walk(condition)):
            if not _said(run, implementation, write):
                found.add(write)
            continue
        if not all(_accounted(run.sorts, condition, (start, declared), state) for state in ends.success):
            found.add(write)
    return frozenset(found)


def effected(effect: Effect) -> Condition | None:
    """Return the condition that an effect makes true."""
    write = write_of(effect)
    if not isinstance(write, Related | Valued):
        return None
    condition = condition_of(write)
    return Not(condition) if condition is not None and isinstance(write, Related) and not write.value else condition


def _accounted(sorts: Sorts, condition: Condition, before: tuple[State, State], state: State) -> bool:
    now = truth(sorts, state, condition)
    return now is not None and any(truth(sorts, _knowing(each, state), condition) is now for each in before)


def _knowing(state: State, other: State) -> State:
    """Return the state with what the other knows of who is who and of which class, which nothing changes."""
    return state.having({fact: true for fact, true in other.facts.items() if isinstance(fact, Same | IsA)})


def _said(run: Run, implementation: Implementation, write: Write) -> bool:
    """Whether a postcondition speaks of what is written, whoever it is of."""
    for _, effect in changes(requirements_of(implementation, "post")):
        own = write_of(effect)
        if isinstance(own, Related) and own == write and own.value is True:
            return True
        if isinstance(own, Valued) and isinstance(write, Valued) and own.property == write.property:
            return own.subject == write.subject and own.value is not None
    return False


def _is_made_up(part: object) -> bool:
    return isinstance(part, Variable) and part.name.startswith("?")


def _unproved(run: Run, implementation: Implementation, post: Requirement, ways: Ways) -> Iterator[Finding]:
    condition = post.clause.meaning
    known = {state: truth(run.sorts, state, condition) for state in ways}
    for value in (False, None):
        found = [way for state, way in ways.items() if known[state] is value]
        if found:
            beyond = value is None and _is_beyond(run.sorts, condition)
            yield Unproved(implementation, post, value is False, beyond, min(found, key=length))
            return


def _is_beyond(sorts: Sorts, condition: Condition) -> bool:
    """Whether a condition says what is not followed: of all individuals, of chains, of computed values."""
    for part in walk(condition):
        match part:
            case Exists() | Forall() | Invoke() | Arithmetic():
                return True
            case Holds(relation=relation):
                if sorts.is_computed(relation):
                    return True
                if sorts.axioms.name.get(relation, (relation, False))[0] in sorts.axioms.loose:
                    return True
            case PropertyOf(property=iri):
                term = sorts.vocabulary.properties.get(iri)
                if term is None or term.computed_by is not None:
                    return True
    return False


def _declared(run: Run, implementation: Implementation, start: State) -> State:
    """Return what a caller takes to be so afterwards."""
    posts = requirements_of(implementation, "post")
    state = applied(run.sorts, start, [effect for _, effect in changes(posts)])
    for post in posts:
        state = learned(run.sorts, state, post.clause.meaning) or state
    return state


def _undeclared(
    run: Run,
    implementation: Implementation,
    one: Effected,
    condition: Condition,
    before: tuple[State, State],
    ways: Ways,
) -> Iterator[Finding]:
    if one.post.sensed or (
        _speaks_of_unnamed(one.effect) and any(one.call is each for each in _repeated(implementation.body))
    ):
        return
    if any(_same_but_for_names(run, one.effect, own) for _, own in changes(requirements_of(implementation, "post"))):
        return
    found = [
        way
        for state, way in ways.items()
        if _passes(way, one.call)
        and truth(run.sorts, state, condition)
        and not any(truth(run.sorts, _knowing(each, state), condition) for each in before)
    ]
    if found:
        yield Undeclared(implementation, one.call, one.post, min(found, key=length))


def _speaks_of_unnamed(effect: Effect) -> bool:
    """Whether an effect is on an individual that the called skill finds by itself."""
    return any(isinstance(part, Variable) and "@" in part.name for part in walk(effect))


def _repeated(body: Body) -> Iterator[Call]:
    """Yield the calls in loops: what they do to others in each round, no postcondition can say."""
    for step in within(body) if isinstance(body, TypedNode) else ():
        if isinstance(step.written, s.While | s.Counted):
            yield from calls_in(step)


def _same_but_for_names(run: Run, effect: Effect, own: Effect) -> bool:
    """Whether both are the same effect, if what the called skill finds by itself is what the caller speaks of."""
    one, other = write_of(effect), write_of(own)
    match one, other:
        case Related(), Related():
            if (one.relation, one.value) != (other.relation, other.value):
                return False
            return _may_mean(run, one.subject, other.subject) and _may_mean(run, one.object, other.object)
        case Valued(), Valued():
            return one.property == other.property and _may_mean(run, one.subject, other.subject)
    return False


def _may_mean(run: Run, one: object, other: object) -> bool:
    if one == other:
        return True
    return isinstance(one, Variable) and "@" in one.name


def _passes(way: Way, call: Call) -> bool:
    return way is not None and any(each.span == call.written.span for each in way)


def _unreleased(run: Run, one: Effected, condition: Condition, start: State, ends: Ends) -> Iterator[Finding]:
    """A value that no success keeps, of which a failure after it leaves the world changed.

    Where things are carried to is no state of a device: a failure leaves them where they are. And where it is the
    undoing that fails, nothing could have undone it.
    """
    if (
        one.post.sensed
        or not isinstance(write_of(one.effect), Valued)
        or not ends.success
        or truth(run.sorts, start, condition) is not False
    ):
        return
    if all(truth(run.sorts, state, condition) is False for state in ends.success):
        failed = ends.failed
        undoing = {
            each.call.written.span for each in run.effects.values() if _undoes(run.sorts, each.effect, condition)
        }
        left = [
            way
            for state, way in failed.items()
            if way is not None and way.span not in undoing and _passes(way, one.call)
            if truth(run.sorts, state, condition)
        ]
        if left:
            yield Unreleased(one.call, one.post, min(left, key=length))


def _undoes(sorts: Sorts, effect: Effect, condition: Condition) -> bool:
    """Whether an effect makes a condition untrue."""
    return truth(sorts, applied(sorts, State(), [effect]), condition) is False
