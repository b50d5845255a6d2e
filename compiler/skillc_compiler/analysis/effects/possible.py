"""What a body may leave changed, in the terms of its skill, and whether a `post possible` says so."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

from msgspec import structs

from skillc_compiler.analysis.binding import call_requirements, class_of, definite_effects, fresh_variable
from skillc_compiler.analysis.exploration import Exploration
from skillc_compiler.analysis.findings import UndeclaredEffect
from skillc_compiler.analysis.initial_state import requirements_of
from skillc_compiler.analysis.knowledge.alias_types import ANY_PREFIX, any_individual, is_any_individual
from skillc_compiler.analysis.knowledge.evaluate import evaluate
from skillc_compiler.analysis.knowledge.possible import (
    FactWrite,
    includes,
    possible_writes,
    single_write,
    with_term,
)
from skillc_compiler.analysis.knowledge.state import State
from skillc_compiler.analysis.knowledge.writes import PropertyWrite, RelationWrite, Write, written_condition
from skillc_compiler.analysis.paths import StatePaths, path_length
from skillc_compiler.analysis.released import contains_call
from skillc_compiler.program.typed import Call, Implementation, Requirement, TypedNode
from skillc_compiler.program.walk import calls_in, nodes_in
from skillc_dsl import syntax as s
from skillc_model.conditions import (
    Aggregate,
    And,
    Assert,
    Condition,
    Expression,
    Holds,
    Individual,
    Literal,
    Not,
    Retract,
    Variable,
)
from skillc_model.read_write import may_change, terms_read, terms_written_by
from skillc_model.rewriting import substitute
from skillc_model.traversal import conjuncts, free_variables
from skillc_rdf.vocabulary.types import THING


@dataclass(frozen=True)
class Possibilities:
    """What may be left changed by a body; `start` is the state at its start."""

    run: Exploration
    implementation: Implementation
    start: State

    def with_possible(self, found: Iterable[UndeclaredEffect]) -> Iterator[UndeclaredEffect]:
        """Yield the effects that no `post possible` includes, each with one that would."""
        for one in found:
            assert one.effect is not None, "it is what a call does"
            write = self._generalise(single_write(one.effect), one.call)
            if not self._is_declared(write):
                yield structs.replace(one, possible=write)

    def undeclared(self, states: StatePaths) -> Iterator[UndeclaredEffect]:
        """Yield what calls say is possible after them, what a success may keep of it, and nothing declares."""
        body = self.implementation.body
        for call in calls_in(body) if isinstance(body, TypedNode) else ():
            said = [each for each in (call.skill.requirements if call.skill else ()) if each.kind == "possible"]
            ways = self._ways_over(call, states) if said else {}
            for post in said if ways else ():
                yield from self._undeclared_of(call, post, ways)

    def of_rounds(self, states: StatePaths) -> Iterator[UndeclaredEffect]:
        """Yield what rounds of loops have done to any one of several, for any other one, and nothing declares."""
        for one in self.run.unsayable.values():
            ways = self._ways_over(one.call, states)
            if ways and not one.post.sensed:
                way = min(ways.values(), key=path_length)
                yield from self.with_possible(
                    (UndeclaredEffect(self.implementation, one.call, one.post, one.effect, way),)
                )

    def _ways_over(self, call: Call, states: StatePaths) -> StatePaths:
        """Return the states after a call; after a loop nothing may be left that tells them from others."""
        over = {state: path for state, path in states.items() if contains_call(path, call)}
        body = self.implementation.body
        loops = (
            (each for each in nodes_in(body) if isinstance(each.written, s.For)) if isinstance(body, TypedNode) else ()
        )
        is_in_loop = any(inner is call for each in loops for inner in calls_in(each))
        return over or (states if is_in_loop and id(call) in self.run.called else {})

    def _undeclared_of(self, call: Call, post: Requirement, ways: StatePaths) -> Iterator[UndeclaredEffect]:
        for each in self._said_by(call, post):
            condition = _condition_of(each)
            if condition is not None and all(evaluate(self.run.types, one, condition) is False for one in ways):
                continue
            write = self._generalise(each, call)
            if not self._is_declared(write):
                way = min(ways.values(), key=path_length)
                yield UndeclaredEffect(self.implementation, call, post, None, way, possible=write)

    def _is_declared(self, write: FactWrite) -> bool:
        """Whether a `post possible` includes a write, or it only ends what a `post` puts something else in place of."""
        return self._is_replaced(write) or any(
            includes(self.run.types, self.start, each, write) for each in self._declared
        )

    def _is_replaced(self, write: FactWrite) -> bool:
        if not isinstance(write, RelationWrite) or write.value is not False:
            return False
        single, canonical = self.run.types.axioms.single_object, self.run.types.axioms.canonical
        if canonical.get(write.relation, (write.relation, False)) not in {(each, False) for each in single}:
            return False
        posts = definite_effects(requirements_of(self.implementation, "post"))
        made = [each for _, each in posts if isinstance(each, Assert)]
        return any((each.subject, each.relation) == (write.subject, write.relation) for each in made)

    @cached_property
    def _declared(self) -> tuple[FactWrite, ...]:
        return tuple(possible_writes(requirements_of(self.implementation, "possible")))

    @cached_property
    def _own(self) -> frozenset[str]:
        return frozenset(each.name for each in self.implementation.skill.parameters)

    @cached_property
    def _writes(self) -> frozenset[Write]:
        body = self.implementation.body
        assert isinstance(body, TypedNode), "only bodies of nodes are proved"
        return self.run.summaries.writes_of_node(body, self.implementation)

    def _said_by(self, call: Call, post: Requirement) -> Iterator[FactWrite]:
        """Yield what is said to be possible after a call, in the terms of the body."""
        yield from (_in_terms_of(each, _values_of(call)) for each in possible_writes((post,)))

    def _generalise(self, write: FactWrite, call: Call) -> FactWrite:
        """Return a write on any individual for each that the skill has no name for, and on which ones."""
        whole, found = write, dict(_classes_of(call))
        conditions = (*(conjuncts(write.when) if write.when is not None else ()), *self._needed_by(call))
        for name in sorted(_names_in(write) - self._own):
            known = self.start.aliases.get(name)
            is_own = isinstance(known, Individual) or (isinstance(known, Variable) and known.name in self._own)
            unknown = any_individual(self.run.types.classes.get(name, found.get(name, THING)))
            term = known if known is not None and is_own else unknown
            whole = with_term(whole, name, term)
            conditions = tuple(substitute(each, {name: term}) for each in conditions)
        ends = (whole.subject, whole.object) if isinstance(whole, RelationWrite) else (whole.subject,)
        unnamed = [each for each in ends if is_any_individual(each)]
        if len(unnamed) != 1:
            return structs.replace(whole, when=None)
        [every] = unnamed
        assert isinstance(every, Variable), "it is a name for any individual"
        about = [each for each in conditions if every.name in free_variables(each) <= self._own | {every.name}]
        kept = tuple(dict.fromkeys(each for each in about if self._was_so(each)))
        return structs.replace(whole, when=None if not kept else kept[0] if len(kept) == 1 else And(kept))

    def _needed_by(self, call: Call) -> Iterator[Condition]:
        """Yield the preconditions of a call, and of what the loops around it are over, in the terms of the body."""
        for each in call_requirements(self.run.program, call, "pre"):
            yield from conjuncts(substitute(each.condition.meaning, _values_of(call)))
        body = self.implementation.body
        for node in nodes_in(body) if isinstance(body, TypedNode) else ():
            items = node.values[0].meaning if isinstance(node.written, s.For) else None
            if isinstance(items, Aggregate) and any(each is call for each in calls_in(node)):
                yield from conjuncts(items.where)

    def _was_so(self, condition: Condition) -> bool:
        """Whether what fulfils a condition in the body has fulfilled it at the start: nothing makes it true."""
        if any(self.run.types.vocabulary.is_computed(iri) for iri in terms_read(condition)):
            return False
        changing = [each for each in self._writes if self._changes(condition, each)]
        if isinstance(condition, Holds):
            return all(isinstance(each, RelationWrite) and each.value is False for each in changing)
        return not changing

    def _changes(self, condition: Condition, write: Write) -> bool:
        vocabulary = self.run.types.vocabulary
        written = frozenset[str]()
        if isinstance(write, RelationWrite):
            one = Variable("one")
            effect = Retract if write.value is False else Assert
            written = terms_written_by(effect(one, write.relation, one), vocabulary)
        elif isinstance(write, PropertyWrite):
            written = frozenset({write.property})
        return any(may_change(iri, written, vocabulary) for iri in terms_read(condition))


def _condition_of(write: FactWrite) -> Condition | None:
    """Return what is so once something is written; None if that is open, or said of any individual."""
    condition = written_condition(write)
    if condition is None or any(is_any_individual(each) for each in map(Variable, free_variables(condition))):
        return None
    return Not(condition) if isinstance(write, RelationWrite) and write.value is False else condition


def _values_of(call: Call) -> dict[str, Expression]:
    """Return the values of a called skill's parameters, with fresh names for what has no name where it is called."""
    passed = {each.name.text: each.value.meaning for each in call.values}
    values: dict[str, Expression] = {}
    for each in call.skill.parameters if call.skill else ():
        value = passed.get(each.name)
        is_name = isinstance(value, Variable | Individual | Literal)
        values[each.name] = value if value is not None and is_name else fresh_variable(call, each)
        if each.direction == "out" and call.out is not None:
            values[each.name] = Variable(call.out.text)
    return values


def _classes_of(call: Call) -> Iterator[tuple[str, str]]:
    for each in call.skill.parameters if call.skill else ():
        yield fresh_variable(call, each).name, class_of(each)


def _in_terms_of(write: FactWrite, values: Mapping[str, Expression]) -> FactWrite:
    """Return a write of a called skill with values for its parameters."""
    ends = ("subject", "object") if isinstance(write, RelationWrite) else ("subject", "value")
    terms = {end: getattr(write, end) for end in ends}
    named = {end: values.get(term.name, term) for end, term in terms.items() if isinstance(term, Variable)}
    when = None if write.when is None else substitute(write.when, values)
    return structs.replace(write, **named, when=when)


def _names_in(write: FactWrite) -> frozenset[str]:
    ends = (write.subject, write.object) if isinstance(write, RelationWrite) else (write.subject, write.value)
    terms = {each.name for each in ends if isinstance(each, Variable) and not is_any_individual(each)}
    read = free_variables(write.when) if write.when is not None else frozenset[str]()
    return frozenset(terms) | {each for each in read if not each.startswith(ANY_PREFIX)}
