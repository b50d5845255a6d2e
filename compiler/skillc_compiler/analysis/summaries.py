"""What a skill may write, whoever calls it: at all, when it fails, and beyond what it says when it succeeds."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from skillc_compiler.analysis.axioms import Axioms
from skillc_compiler.analysis.binding import candidates, changes, class_of
from skillc_compiler.analysis.opening import name_sorts, opening, requirements_of
from skillc_compiler.analysis.sorts import Sorts, some
from skillc_compiler.analysis.truth import truth
from skillc_compiler.analysis.writes import Assigned, Ended, Related, Valued, Write, either_way, write_of
from skillc_compiler.analysis.writing import applied
from skillc_compiler.program.typed import Call, Implementation, Program, Skill, TypedNode
from skillc_compiler.program.types import Thing
from skillc_dsl import syntax as s
from skillc_model.conditions import Anything, Expression, Individual, Literal, Term, Variable
from skillc_rdf.vocabulary.types import THING

NONE: frozenset[Write] = frozenset()


class Summaries:
    """Worked out once for each skill and each node; whoever calls itself adds nothing to itself."""

    def __init__(self, program: Program, axioms: Axioms) -> None:
        self._program = program
        self._axioms = axioms
        self._whole: dict[str, frozenset[Write]] = {}
        self._steps: dict[int, frozenset[Write]] = {}
        self._holding: dict[str, bool] = {}
        self._names: dict[str, frozenset[str]] = {}

    def anything(self, implementation: Implementation) -> frozenset[Write]:
        """Return what the implementation may write before it ends in any way."""
        if implementation.key not in self._whole:
            self._whole[implementation.key] = NONE
            self._whole[implementation.key] = frozenset(self._of(implementation))
        return self._whole[implementation.key]

    def on_failure(self, implementation: Implementation) -> frozenset[Write]:
        """Return what may have been written when the implementation has not succeeded.

        A primitive that fails wrote what it measured, and its effects only if it failed by its own promises.
        """
        if isinstance(implementation.body, TypedNode) or not self._keeps_promises(implementation):
            return self.anything(implementation)
        return NONE

    def _keeps_promises(self, implementation: Implementation) -> bool:
        """Whether a primitive's posts hold once they are written, so that writing them is the last it does."""
        posts = requirements_of(implementation, "post")
        if any(post.sensed for post in posts) or any(p.direction == "out" for p in implementation.parameters):
            return False
        sorts = Sorts(self._program.vocabulary, self._axioms)
        name_sorts(sorts, implementation)
        state = applied(sorts, opening(sorts, implementation), [effect for _, effect in changes(posts)])
        return all(truth(sorts, state, post.clause.meaning) for post in posts)

    def of_call(self, call: Call, failing: bool = False) -> frozenset[Write]:
        """Return what a call may write, in the caller's words; who the skill finds by itself may be anybody fitting."""
        if call.skill is None:
            return NONE
        values = _values(call, call.skill)
        found = {
            _seen(write, values)
            for one in candidates(self._program, call)
            for write in (self.on_failure(one) if failing else self.anything(one))
        }
        return frozenset(found)

    def of_step(self, step: TypedNode, implementation: Implementation | None) -> frozenset[Write]:
        """Return what a node may write."""
        if id(step) not in self._steps:
            self._steps[id(step)] = frozenset(self._of_step(step, implementation))
        return self._steps[id(step)]

    def lasting(self, call: Call, around: tuple[str, ...] = ()) -> frozenset[Write]:
        """Return what scoped skills write that stays in place after the call, until a `with` around it ends.

        `around` names the skills whose bodies this is in.
        """
        if call.skill is None or call.skill.name in around:
            return NONE
        if "scoped" in call.skill.flags:
            return self.of_call(call)
        bodies = [one.body for one in candidates(self._program, call) if isinstance(one.body, TypedNode)]
        inner = (
            write
            for body in bodies
            for each in calls_in(body)
            for write in self.lasting(each, (*around, call.skill.name))
        )
        return seen_from(call, hidden(inner, [p.name for p in call.skill.parameters]))

    def names(self, call: Call) -> frozenset[str]:
        """Return the names of all skills that a call may run."""
        if call.skill is None:
            return frozenset()
        if call.skill.name not in self._names:
            self._names[call.skill.name] = frozenset({call.skill.name})
            known = self._program.implementations_of.get(call.skill.name, ())
            bodies = [one.body for one in known if isinstance(one.body, TypedNode)]
            inner = (self.names(each) for body in bodies for each in calls_in(body))
            self._names[call.skill.name] = frozenset({call.skill.name}).union(*inner)
        return self._names[call.skill.name]

    def may_break(self, skill: Skill) -> bool:
        """Whether some run of the skill may end because a hold broke, or because a `verify` line forbids what is."""
        if skill.name not in self._holding:
            self._holding[skill.name] = False
            self._holding[skill.name] = self._may_break(skill)
        return self._holding[skill.name]

    def _may_break(self, skill: Skill) -> bool:
        known = self._program.implementations_of.get(skill.name, ())
        holds = any(each.kind == "hold" for one in known for each in (*skill.requirements, *one.requirements))
        watched = any(line.pattern == "never" and line.first.skill is None for one in known for line in one.verify)
        return (
            holds
            or watched
            or any(
                self.may_break(call.skill)
                for one in known
                if isinstance(one.body, TypedNode)
                for call in calls_in(one.body)
                if call.skill is not None
            )
        )

    def _of(self, implementation: Implementation) -> Iterator[Write]:
        if isinstance(implementation.body, TypedNode):
            visible = [p.name for p in implementation.parameters if p.direction != "out"]
            whole = self.of_step(implementation.body, implementation)
            yield from hidden((write for write in whole if isinstance(write, Related | Valued)), visible)
            return
        for post, effect in changes(requirements_of(implementation, "post")):
            yield either_way(write_of(effect)) if post.sensed else write_of(effect)

    def _of_step(self, step: TypedNode, implementation: Implementation | None) -> Iterator[Write]:
        if step.call is not None:
            yield from self.of_call(step.call)
            if step.call.out is not None:
                yield Assigned(step.call.out.text)
        if isinstance(step.written, s.ApplyPosts) and implementation is not None:
            labels = {name.text for name in step.written.labels}
            posts = [
                post for post in requirements_of(implementation, "post") if post.label and post.label.text in labels
            ]
            yield from (write_of(effect) for _, effect in changes(posts))
        if isinstance(step.written, s.Block) and step.written.kind == "once":
            yield Ended(key_of(step))
        for child in (*step.children, *step.orelse):
            yield from self.of_step(child, implementation)


def key_of(step: TypedNode) -> int:
    """Return a number that no other node of the same body has."""
    return step.written.span.line * 100_000 + step.written.span.column


def seen_from(call: Call, writes: frozenset[Write]) -> frozenset[Write]:
    """Return writes of a called skill in the caller's words."""
    values = _values(call, call.skill) if call.skill else {}
    return frozenset(_seen(write, values) for write in writes)


def calls_in(step: TypedNode) -> Iterator[Call]:
    """Yield the calls in a node."""
    if step.call is not None:
        yield step.call
    for child in (*step.children, *step.orelse):
        yield from calls_in(child)


def _values(call: Call, skill: Skill) -> Mapping[str, Expression]:
    """Return what the caller calls the individuals of the skill; a made-up one for those it has no lasting name for."""
    values: dict[str, Expression] = {p.name: some(class_of(p)) for p in skill.parameters}
    for argument in call.arguments:
        meaning = argument.value.meaning
        kind = argument.value.type
        if isinstance(meaning, Individual | Literal | Variable):
            values[argument.name.text] = meaning
        elif isinstance(kind, Thing):
            values[argument.name.text] = some(kind.cls or THING)
    return values


def _seen(write: Write, values: Mapping[str, Expression]) -> Write:
    match write:
        case Related(subject=subject, relation=relation, object=object_, value=value):
            return Related(_term(subject, values), relation, _term(object_, values), value)
        case Valued(subject=subject, property=iri, value=value, cleared=cleared):
            new = values.get(value.name) if isinstance(value, Variable) else value
            known = new if isinstance(new, Literal | Variable | Individual) and not _is_some(new) else None
            return Valued(_term(subject, values), iri, known, cleared)
        case Assigned() | Ended():
            return write


def _term(term: Term, values: Mapping[str, Expression]) -> Term:
    if not isinstance(term, Variable) or _is_some(term):
        return term
    found = values.get(term.name, some(THING))
    return found if isinstance(found, Variable | Individual | Anything) else some(THING)


def hidden(writes: Iterable[Write], visible: Iterable[str]) -> frozenset[Write]:
    """Return the writes with someone unknown in the place of each name that is not visible."""
    names = {name: Variable(name) for name in visible}
    return frozenset(_seen(write, names) for write in writes)


def _is_some(term: object) -> bool:
    return isinstance(term, Variable) and term.name.startswith("?")
