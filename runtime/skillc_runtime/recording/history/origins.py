"""Where the value of a parameter comes from, through every call: expressions, defaults, facts, outputs of calls."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Literal, TypeAlias, assert_never

import msgspec

from skillc_dsl.position import Position
from skillc_runtime.recording.history.history import RecordedCall, RecordedFact, RunHistory
from skillc_runtime.recording.reasons import DecidingCondition, NameInExpression, WrittenExpression
from skillc_runtime.world.state.labels.labelled import LabelledFact, LabelledIri, LabelledValue

FindPlace: TypeAlias = Callable[[LabelledFact], Position | None]
"""Finds where the scene states a fact; None if it does not, or that is not known."""


class LocatedFact(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """A fact that was read, and when and by what it was written, or else its `place` in the scene."""

    known: RecordedFact
    place: Position | None = None


class ValueOrigin(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """Where the value of a name comes from, and below it the same for each name that it was computed from.

    `call` is the number of the call of whose parameter or body it is a name, empty in a task. `how` is `passed` by the
    caller, `planned`, a `default`, `inferred`, a `let`, an item of a `loop`, the `output` of the call `by`, or `given`
    to the task. `text` and `source` are the expression, of an output its name and the place of the call. A value that
    was inferred fulfils the `conditions`; `others` are the individuals that `infer any` could have chosen as well.
    """

    name: str
    call: str
    how: Literal["passed", "planned", "default", "inferred", "let", "loop", "output", "given"]
    value: LabelledValue | None = None
    text: str = ""
    source: Position | None = None
    by: str = ""
    facts: tuple[LocatedFact, ...] = ()
    conditions: tuple[DecidingCondition, ...] = ()
    others: tuple[LabelledIri, ...] = ()
    names: tuple[ValueOrigin, ...] = ()


def trace_values(
    story: RunHistory, calls: Iterable[RecordedCall], parameter: str, find_place: FindPlace
) -> tuple[ValueOrigin, ...]:
    """Return where the value of a parameter comes from, for each of these calls in which it is bound."""
    tracing = _Tracing(story, find_place)
    return tuple(tracing.trace(each, parameter) for each in calls if parameter in each.bindings)


class _Tracing:
    """Follows values from call to call."""

    def __init__(self, story: RunHistory, find_place: FindPlace) -> None:
        self._calls = {each.number: each for each in story.calls}
        self._find_place = find_place
        self._outputs: dict[tuple[str, str], list[RecordedCall]] = {}  # the calls of a body that give a name its value
        for each in self._calls.values():
            if each.out and each.outputs:
                self._outputs.setdefault((_number_around(each), each.out), []).append(each)

    def trace(self, call: RecordedCall, parameter: str) -> ValueOrigin:
        """Return where the value of a parameter comes from."""
        reason = next((each for each in call.determined if each.parameter == parameter), None)
        how, conditions = ("passed", ()) if reason is None else (reason.how, reason.conditions)
        origin = ValueOrigin(
            name=parameter,
            call=call.number,
            how="planned" if call.planned and how == "passed" else how,
            value=call.bindings.get(parameter),
            conditions=conditions,
            others=reason.others if reason is not None else (),
            facts=tuple(self._locate(fact, call) for fact in _deciding(conditions)),
        )
        written = call.expressions.get(parameter)
        return origin if written is None or origin.how == "planned" else self._add_expression(origin, written, call)

    def _add_expression(self, origin: ValueOrigin, written: WrittenExpression, call: RecordedCall) -> ValueOrigin:
        """Return an origin with an expression in the body around a call; a default has no names."""
        return msgspec.structs.replace(
            origin,
            text=written.text,
            source=written.source,
            facts=(*origin.facts, *(self._locate(fact, call) for fact in written.facts)),
            names=tuple(self._trace_name(each, call) for each in written.names),
        )

    def _trace_name(self, name: NameInExpression, call: RecordedCall) -> ValueOrigin:
        """Return where the value of a name in the body around a call comes from."""
        number = _number_around(call)
        match name.how:
            case "let" | "loop" | "given":
                origin = ValueOrigin(name=name.name, call=number, how=name.how, value=name.value)
                return origin if name.expression is None else self._add_expression(origin, name.expression, call)
            case "parameter":
                return self.trace(self._calls[number], name.name)
            case "output":
                return self._trace_output(name.name, number, call)
            case _:
                assert_never(name.how)

    def _trace_output(self, name: str, number: str, call: RecordedCall) -> ValueOrigin:
        """Return the output that gave a name its value in the body of call `number`, before a call in it started."""
        origin = ValueOrigin(name=name, call=number, how="output")
        before = [each for each in self._outputs.get((number, name), ()) if _ended_before(each, call)]
        if not before:
            return origin  # the recording began after that call
        last = before[-1]
        output, value = next(iter(last.outputs.items()))
        return msgspec.structs.replace(origin, value=value, text=output, by=last.number, source=last.source)

    def _locate(self, fact: LabelledFact, call: RecordedCall) -> LocatedFact:
        written = next((each for each in call.written if each.fact == fact), None)
        if written is not None:
            return LocatedFact(known=written)
        return LocatedFact(known=RecordedFact(fact=fact), place=self._find_place(fact))


def _number_around(call: RecordedCall) -> str:
    """Return the number of the call in whose body a call stands; empty in a task."""
    return call.number.rpartition(".")[0]


def _deciding(conditions: tuple[DecidingCondition, ...]) -> Iterator[LabelledFact]:
    return iter(dict.fromkeys(fact for condition in conditions for fact in condition.facts))


def _ended_before(one: RecordedCall, other: RecordedCall) -> bool:
    return one.ended is not None and other.started is not None and one.ended <= other.started
