"""By how much a body changes a number: the sum of what its steps do, over branches and rounds."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, reduce
from math import inf
from typing import NamedTuple, assert_never

from skillc_compiler.analysis.applied import applied_posts
from skillc_compiler.analysis.binding import definite_effects, fresh_variable
from skillc_compiler.analysis.effects.values import Values
from skillc_compiler.analysis.exploration import Exploration
from skillc_compiler.analysis.knowledge.state import IndividualTerm, State
from skillc_compiler.analysis.knowledge.writes import PropertyWrite, Write
from skillc_compiler.analysis.loops import count_rounds
from skillc_compiler.logic.sums import OPEN, UNCHANGED, Change, join, repeat
from skillc_compiler.program.typed import Call, Implementation, TypedNode
from skillc_dsl import syntax as s
from skillc_model.conditions import (
    Adjust,
    Aggregate,
    Assign,
    Effect,
    Expression,
    ForEach,
    Individual,
    ListValue,
    SingleEffect,
    Variable,
)
from skillc_model.rewriting import ALWAYS, substitute


class Ends(NamedTuple):
    """What has become of the number when a node succeeds and when it fails; None if it never does."""

    success: Change | None
    failure: Change | None


NOTHING = Ends(UNCHANGED, UNCHANGED)


@dataclass(frozen=True)
class Amounts:
    """Finds what a body does to one number of one individual, which no item of a round is unless it is said."""

    run: Exploration
    implementation: Implementation
    start: State
    of: IndividualTerm
    property: str
    items: Mapping[str, bool | None]

    @cached_property
    def values(self) -> Values:
        """What is known of the values in amounts."""
        return Values(self.run, self.implementation, self.start)

    def change(self, effect: SingleEffect) -> Change:
        """Return what an effect does to the number."""
        if not isinstance(effect, Assign | Adjust) or effect.property != self.property:
            return UNCHANGED
        is_it = self._is_it(effect.subject)
        if is_it is False:
            return UNCHANGED
        change = self.values.change_by(effect)
        return change if is_it else join(change, UNCHANGED, self.values.bounds) or OPEN

    def ends(self, node: TypedNode) -> Ends:
        """Return what a node does to the number."""
        if id(node) not in self.run.reached:
            return Ends(None, None)
        match node.written:
            case s.CallSkill():
                return self._call(node.call) if node.call is not None else NOTHING
            case s.ApplyPosts():
                effects = (each for _, each in definite_effects(applied_posts(self.implementation, node)))
                return Ends(reduce(Change.then, map(self._change_of_any, effects), UNCHANGED), None)
            case s.Fail():
                return Ends(None, UNCHANGED)
            case s.Wait() | s.WaitUntil() | s.CheckNode():
                return NOTHING
            case s.While() | s.For():
                return self._loop(node, node.written)
            case _:
                return self._of_children(node, node.written)

    def _of_children(
        self, node: TypedNode, written: s.Block | s.Decorator | s.If | s.With | s.OnFailure | s.Finally
    ) -> Ends:
        match written:
            case s.Block(kind=kind):
                return self._block(node.children, kind)
            case s.Decorator(kind=kind):
                return self._decorator(node, kind)
            case s.If():
                return self._join(self._sequence(node.children), self._sequence(node.orelse))
            case s.With():
                return self._with(node)
            case s.OnFailure():
                inner, last = self.ends(node.children[0]), self._sequence(node.orelse)
                recovered = self._then(inner.failure, last.success)
                return Ends(self._either(inner.success, recovered), self._then(inner.failure, last.failure))
            case s.Finally():
                inner, last = self.ends(node.children[0]), self._sequence(node.orelse)
                end = self._either(last.success, last.failure)
                return Ends(self._then(inner.success, end), self._then(inner.failure, end))
            case _:
                assert_never(written)

    def may_change(self, writes: Iterable[Write]) -> bool:
        """Whether any of these writes may be on the number."""
        found = (each for each in writes if isinstance(each, PropertyWrite) and each.property == self.property)
        return any(self._is_it(each.subject) is not False for each in found)

    def _is_it(self, subject: object) -> bool | None:
        """Whether a value stands for the individual; None if it may."""
        if isinstance(subject, Variable) and subject.name in self.items:
            return self.items[subject.name]
        thing = self.start.aliases.get(subject.name, subject) if isinstance(subject, Variable) else subject
        if thing == self.of:
            return True
        if not isinstance(thing, Variable | Individual):  # what is computed may be any
            return None
        return None if self.run.types.may_be_same(self.start, thing, self.of) else False

    def _change_of_any(self, effect: Effect) -> Change:
        if not isinstance(effect, ForEach):
            return self.change(effect)
        change = self.change(substitute(effect.effect, {effect.variable: self.of}))
        return change if effect.when == ALWAYS else join(change, UNCHANGED, self.values.bounds) or OPEN

    def _either(self, one: Change | None, other: Change | None) -> Change | None:
        return join(one, other, self.values.bounds)

    def _join(self, one: Ends, other: Ends) -> Ends:
        return Ends(self._either(one.success, other.success), self._either(one.failure, other.failure))

    def _then(self, one: Change | None, later: Change | None) -> Change | None:
        return None if one is None or later is None else one.then(later)

    def _times(self, change: Change | None, least: int, most: float) -> Change | None:
        if change is None:
            return UNCHANGED if least <= 0 else None
        return repeat(change, max(least, 0), max(most, 0), self.values.bounds)

    def _sequence(self, children: Sequence[TypedNode]) -> Ends:
        done, failed = UNCHANGED, None
        for child in children:
            one = self.ends(child)
            failed = self._either(failed, self._then(done, one.failure))
            later = self._then(done, one.success)
            if later is None:
                return Ends(None, failed)
            done = later
        return Ends(done, failed)

    def _block(self, children: Sequence[TypedNode], kind: str) -> Ends:
        if kind == "seq":
            return self._sequence(children)
        if kind == "sel":
            ends = Ends(None, UNCHANGED)
            for child in children:
                one = self.ends(child)
                success = self._either(ends.success, self._then(ends.failure, one.success))
                ends = Ends(success, self._then(ends.failure, one.failure))
            return ends
        halted = reduce(Change.then, map(self._any_part, children), UNCHANGED)
        if kind != "par all":
            return Ends(halted, halted)
        return Ends(self._sequence(children).success, halted)

    def _any_part(self, node: TypedNode) -> Change:
        """Return what a node does to the number that may be halted, or run again."""
        return OPEN if self.may_change(self.run.summaries.writes_of_node(node, self.implementation)) else UNCHANGED

    def _decorator(self, node: TypedNode, kind: str) -> Ends:
        one = self._sequence(node.children)
        match kind:
            case "try":
                return Ends(self._either(one.success, one.failure), None)
            case "invert":
                return Ends(one.failure, one.success)
            case "once":
                return Ends(self._either(one.success, UNCHANGED), self._either(one.failure, UNCHANGED))
            case "timeout":
                return Ends(one.success, reduce(Change.then, map(self._any_part, node.children), UNCHANGED))
            case "retry":
                least, most = count_rounds(self.run, node)
                failed = self._times(one.failure, 0, most - 1)
                return Ends(self._then(failed, one.success), self._times(one.failure, least, most))
            case "repeat":
                least, most = count_rounds(self.run, node)
                before = self._times(one.success, 0, most - 1)
                return Ends(self._times(one.success, least, most), self._then(before, one.failure))
        return Ends(OPEN, OPEN) if self._any_part(node) == OPEN else one

    def _loop(self, node: TypedNode, written: s.While | s.For) -> Ends:
        if isinstance(written, s.For):
            return self._for(node, written.variable.text)
        one, most = self._sequence(node.children), count_rounds(self.run, node)[1]
        before = self._times(one.success, 0, most)
        failed = self._then(self._times(one.success, 0, most - 1), one.failure)
        return Ends(before, self._either(before, failed))

    def _for(self, node: TypedNode, name: str) -> Ends:
        items = node.values[0].meaning
        if isinstance(items, ListValue):
            known = (self._with_item(name, self._is_it(each)) for each in items.items)
            return reduce(self._after, (each._sequence(node.children) for each in known), Ends(UNCHANGED, None))
        others = self._with_item(name, is_it=False if isinstance(items, Aggregate) else None)._sequence(node.children)
        before = self._times(others.success, 0, inf)
        ends = Ends(before, self._then(before, others.failure))
        has_round = self.run.rounds.get((id(node), self.of), {None})
        if not isinstance(items, Aggregate) or has_round == {False}:
            return ends
        own = self._with_item(name, is_it=True)._sequence(node.children)
        middle = Ends(self._then(before, own.success), self._then(before, own.failure))
        with_own = Ends(self._then(middle.success, before), self._either(middle.failure, ends.failure))
        return with_own if has_round == {True} else self._join(ends, with_own)

    def _after(self, before: Ends, one: Ends) -> Ends:
        failed = self._either(before.failure, self._then(before.success, one.failure))
        return Ends(self._then(before.success, one.success), failed)

    def _with_item(self, name: str, is_it: bool | None) -> Amounts:
        return Amounts(self.run, self.implementation, self.start, self.of, self.property, {**self.items, name: is_it})

    def _with(self, node: TypedNode) -> Ends:
        assert node.call is not None, "`with` has a call"
        if self.may_change(self.run.summaries.writes_of_call(node.call)):
            return Ends(OPEN, OPEN)
        inner = self._sequence(node.children)
        return Ends(inner.success, self._either(inner.failure, UNCHANGED))

    def _call(self, call: Call) -> Ends:
        may_fail = self.run.summaries.writes_of_call(call, failing=True)
        failure = OPEN if self.may_change(may_fail) else UNCHANGED
        if self.may_change(self.run.summaries.possible_writes_of(call)):
            return Ends(OPEN, failure)
        return Ends(reduce(Change.then, self._changes_by(call), UNCHANGED), failure)

    def _changes_by(self, call: Call) -> Iterator[Change]:
        """Yield what each postcondition of a call does, whatever it has found at run time."""
        values = dict(_passed(call))
        posts: dict[int, list[Effect]] = {}
        for one in self.run.effects.values():
            if one.call is call and one.post.kind == "post" and not one.of_loop:
                posts.setdefault(id(one.post), []).append(substitute(one.effect, values))
        for effects in posts.values():
            many = [each for each in effects if isinstance(each, ForEach)]
            yield from self._of_post(many or effects)

    def _of_post(self, effects: Sequence[Effect]) -> Iterator[Change]:
        changes = [self._change_of_any(each) for each in effects]
        whole = changes[0]
        for each in changes[1:]:
            whole = join(whole, each, self.values.bounds) or OPEN
        yield whole


def _passed(call: Call) -> Iterator[tuple[str, Expression]]:
    """Yield the values of arguments for the names that stand for them where they are computed."""
    for argument in call.values:
        parameter = call.skill.parameter(argument.name.text) if call.skill else None
        if parameter is not None:
            yield fresh_variable(call, parameter).name, argument.value.meaning
