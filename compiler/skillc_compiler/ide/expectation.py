"""The type of value expected at the cursor."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from skillc_compiler.ide.calls import OpenCall, find_open_call
from skillc_compiler.ide.cursor_context import CursorContext
from skillc_compiler.program.typed import Skill
from skillc_compiler.program.types import INT, Measure, Thing, Type, Vector, fits, type_of
from skillc_compiler.resolve.references import ANYTHING, ExpectedType
from skillc_compiler.resolve.type_names import BUILT_IN, is_built_in
from skillc_dsl.parsing.tokens import Token
from skillc_dsl.units import DIMENSIONS, NUMBER, TIME, UNITS

CHANGES = ("PLUS_EQUAL", "MINUS_EQUAL", "COLON_EQUAL")
_COMPARISONS = ("EQUALS", "UNEQUAL", "LESS", "LESS_EQUAL", "MORE", "MORE_EQUAL", *CHANGES)
_TIMES = ("DURATION", "KEEP", "WAIT", "TIMEOUT")
_COUNTS = ("RETRY", "REPEAT")
_SAME_AS_LEFT = ("PLUS", "MINUS")


def find_expected_type(around: CursorContext, skills: Mapping[str, Skill], tokens: Sequence[Token]) -> ExpectedType:
    """Return the type of value expected after `tokens`, as far as they determine it."""
    last = tokens[-1].type if tokens else ""
    if last in _COMPARISONS:
        return _compared(around, tokens[:-1])
    if last in _TIMES:
        return ExpectedType(Measure(TIME))
    if last == "COST":
        return ExpectedType(Measure(NUMBER))
    if last in _COUNTS:
        return ExpectedType(INT)
    if last in ("EQUAL", "RANGE", "DOTS"):
        return _declared(around, tokens)
    if last in _SAME_AS_LEFT:
        return _beside(around, skills, tokens)
    call = find_open_call(tokens) if last in ("LABEL", "LPAR", "COMMA") else None
    return _argument(around, skills, call) if call else ANYTHING


def _compared(around: CursorContext, tokens: Sequence[Token]) -> ExpectedType:
    iri = around.visible.term("property", tokens[-1].value) if len(tokens) > 1 and tokens[-2].type == "DOT" else None
    term = around.visible.vocabulary.properties.get(iri) if iri else None
    return ExpectedType(around.type_of(tokens), term.values if term else ())


def _declared(around: CursorContext, tokens: Sequence[Token]) -> ExpectedType:
    """Return the type declared after the last label, for a default or the bounds of a range."""
    skill = around.skill
    if [token.type for token in tokens[-3:]] == ["OUT", "NAME", "EQUAL"] and skill is not None:
        output = skill.parameter(tokens[-2].value)
        return ExpectedType(output.type) if output is not None else ANYTHING
    labels = [index for index, token in enumerate(tokens) if token.type == "LABEL"]
    defines = tokens[0].type == "RELATION"
    if defines or not labels or labels[-1] + 1 >= len(tokens) or tokens[-2].type == "LET":
        return ANYTHING
    name, *rest = tokens[labels[-1] + 1 :]
    if name.value == "Vector" and len(rest) > 1 and rest[0].type == "OF" and rest[1].value in DIMENSIONS:
        return ExpectedType(Vector(DIMENSIONS[rest[1].value]))
    iri = around.visible.term("class", name.value)
    if is_built_in(name.value, iri is not None):
        return ExpectedType(type_of(BUILT_IN[name.value]))
    return ExpectedType(Thing(iri)) if iri else ANYTHING


def _beside(around: CursorContext, skills: Mapping[str, Skill], tokens: Sequence[Token]) -> ExpectedType:
    """Return the type of the left operand of `+` or `-`; the sign of a number is skipped."""
    before = tokens[-2] if len(tokens) > 1 else None
    if before is None or before.type in (*_COMPARISONS, *_TIMES, "EQUAL", "RANGE", "DOTS", "LABEL", "LPAR", "COMMA"):
        return find_expected_type(around, skills, tokens[:-1])
    if before.type == "QUANTITY":
        unit = UNITS.get(before.value.lstrip("0123456789.eE+-").strip())
        return ExpectedType(Measure(unit.dimension)) if unit else ANYTHING
    return ExpectedType(around.type_of(tokens[:-1]))


def _argument(around: CursorContext, skills: Mapping[str, Skill], call: OpenCall) -> ExpectedType:
    skill = skills.get(call.name)
    if skill is not None:
        parameter = skill.parameter(call.label) if call.label else None
        return ExpectedType(parameter.type) if parameter else ANYTHING
    function = around.visible.vocabulary.functions.get(call.name)
    if function is None or call.position >= len(function.parameters):
        return ANYTHING
    return ExpectedType(type_of(function.parameters[call.position][1]))


def find_ranges(around: CursorContext, relation: str, subject: Type) -> tuple[str, ...]:
    """Return the classes that the objects of a relation can have for a subject of this type."""
    iri = around.visible.term("relation", relation)
    term = around.visible.vocabulary.relations.get(iri) if iri else None
    signatures = term.signatures if term else ()
    fitting = [x.range for x in signatures if fits(around.visible.vocabulary, subject, Thing(x.domain))]
    return tuple(fitting or (x.range for x in signatures))
