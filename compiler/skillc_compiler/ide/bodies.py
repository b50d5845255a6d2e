"""The names in bodies: calls, arguments, outputs, loops, labels."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import assert_never

import msgspec

from skillc_compiler.ide.symbols import (
    ImplementationSymbol,
    LabelSymbol,
    LocalSymbol,
    Occurrence,
    ParameterSymbol,
    SkillSymbol,
    Symbol,
)
from skillc_compiler.ide.values import Locals, ValueOccurrences
from skillc_compiler.program.types import MESSAGE
from skillc_dsl import syntax as s
from skillc_dsl.source import Span


class BodyContext(msgspec.Struct, frozen=True):
    """The declaration that a body belongs to: its place, and the skill and implementation unless it is a task."""

    span: Span
    skill: str = ""
    implementation: str = ""


class BodyOccurrences(ValueOccurrences, frozen=True):
    """Finds the occurrences in bodies. A name bound by a node is visible in the nodes after it."""

    def node(self, home: BodyContext, known: dict[str, Symbol], written: s.Node) -> Iterator[Occurrence]:
        """Yield the occurrences in a node; the names that it binds are added to `known`."""
        match written:
            case s.Block(children=children):
                yield from self.nodes(home, known, children)
            case s.Decorator(slots=slots, children=children):
                yield from (each for slot in slots for each in self.value(known, slot))
                yield from self.nodes(home, known, children)
            case s.Wait() | s.Fail():
                values = (written.time,) if isinstance(written, s.Wait) else written.message.values
                yield from (each for value in values for each in self.value(known, value))
            case s.WaitUntil(condition=condition) | s.CheckNode(condition=condition):
                yield from self.condition(known, condition)
            case s.If(condition=condition):
                yield from self.condition(known, condition)
                yield from self.nodes(home, known, (*written.then, *(written.orelse or ())))
            case s.While() | s.For():
                yield from self._loop(home, known, written)
            case s.ApplyPosts(labels=labels):
                for label in labels:
                    yield Occurrence(label.span, self.label(home, label.text))
            case s.CallSkill():
                yield from self.call(home, known, written)
            case s.With(call=call, children=children):
                yield from self.call(home, known, call)
                yield from self.nodes(home, known, children)
            case s.OnFailure() | s.Finally():
                yield from self._ending(home, known, written)
            case _:
                assert_never(written)

    def nodes(self, home: BodyContext, known: dict[str, Symbol], written: Sequence[s.Node]) -> Iterator[Occurrence]:
        """Yield the occurrences in consecutive nodes."""
        for node in written:
            yield from self.node(home, known, node)

    def label(self, home: BodyContext, text: str) -> LabelSymbol:
        """Return the label with this name: that of the skill if it declares one, else that of the implementation."""
        own = f"{home.skill}.{home.implementation}"
        return LabelSymbol(home.skill if (home.skill, text) in self.labels else own, text)

    def _loop(self, home: BodyContext, known: dict[str, Symbol], written: s.While | s.For) -> Iterator[Occurrence]:
        if isinstance(written, s.While):
            yield from self.condition(known, written.condition)
            yield from self.value(known, written.limit)
            yield from self.nodes(home, known, written.children)
            return
        symbol, items = LocalSymbol("loop variable", written.span, written.variable.text), written.items
        inner: dict[str, Symbol] = {written.variable.text: symbol, **known}
        if isinstance(items, s.Every):
            yield from self.members(inner, items.cls, items.where, items.by)
        else:
            yield from self.value(known, items)
        yield from self.bound(known, written.variable, symbol)
        yield from self.nodes(home, inner, written.children)
        known.update({name: found for name, found in inner.items() if found != symbol})

    def _ending(
        self, home: BodyContext, known: dict[str, Symbol], written: s.OnFailure | s.Finally
    ) -> Iterator[Occurrence]:
        yield from self.node(home, known, written.node)
        if isinstance(written, s.Finally):
            yield from self.nodes(home, known, written.last)
            return
        inner = dict(known)
        if written.why is not None:
            symbol = LocalSymbol("failure", written.span, written.why.text)
            inner[written.why.text] = symbol
            yield from self.bound(known, written.why, symbol)
        yield from self.nodes(home, inner, written.handler)

    def call(self, home: BodyContext, known: dict[str, Symbol], written: s.CallSkill) -> Iterator[Occurrence]:
        """Yield the occurrences in a call; the name of its output is added to `known`."""
        skill = written.skill.text
        if skill in self.visible.skills:
            yield Occurrence(written.skill.span, SkillSymbol(skill))
            if written.implementation is not None:
                symbol = ImplementationSymbol(skill, written.implementation.text)
                yield Occurrence(written.implementation.span, symbol)
        for argument in written.arguments:
            yield from self._argument(known, skill, argument)
        if written.out is not None:
            symbol_ = LocalSymbol("output", home.span, written.out.text)
            yield from self.bound(known, written.out, symbol_)
            known.setdefault(written.out.text, symbol_)

    def _argument(self, known: Locals, skill: str, written: s.Argument) -> Iterator[Occurrence]:
        called, value = self.skills.get(skill), written.value
        parameter = called.parameter(written.name.text) if called else None
        short = written.value.span == written.name.span
        if parameter is not None:
            symbol = ParameterSymbol.of(skill, parameter)
            yield Occurrence(written.name.span, symbol, shorthand=short)
        for occurrence in self.passed(known, value, parameter is not None and parameter.type == MESSAGE):
            yield Occurrence(occurrence.span, occurrence.symbol, shorthand=short)
