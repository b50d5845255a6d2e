"""Emits docs/: a Markdown page per skill and an index."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, assert_never

from skillc_compiler.emit.docs.traits import describe_flags, describe_pause
from skillc_dsl.units import to_si
from skillc_model.conditions import Expression, Literal
from skillc_model.format_condition import format_expression, format_literal
from skillc_model.format_type import format_quantity, format_type
from skillc_model.rewriting import constant_number
from skillc_model.skills import Compound, Declared, Implementation, Parameter, Primitive, Skill, SkillLibrary
from skillc_model.templates import open_templates
from skillc_model.traversal import find_calls
from skillc_rdf.vocabulary.types import NumberType, ValueType, Vocabulary

if TYPE_CHECKING:
    from jinja2 import Template

KINDS = {"in": "required", "opt": "optional", "infer": "inferred", "out": "output"}


def emit(library: SkillLibrary) -> dict[str, str]:
    """Return the pages by path."""
    skills = [skill for _, skill in sorted(library.skills.items())]
    pages = {f"docs/{skill.name}.md": _page(skill, library) for skill in skills}
    return {**pages, "docs/index.md": _template("index.md.j2").render(library=library, skills=skills)}


def _page(skill: Skill, library: SkillLibrary) -> str:
    vocabulary = library.vocabulary
    conditions = [
        ("Preconditions", skill.pre),
        ("Holds while running", skill.hold),
        ("Postconditions", skill.post),
        ("Possible afterwards", skill.possible),
        ("Outcomes, of which one comes true", skill.outcomes),
    ]
    return _template("skill.md.j2").render(
        skill=skill,
        parameters=[_parameter(each, vocabulary) for each in skill.parameters],
        conditions=[(title, listed) for title, listed in conditions if listed],
        duration=format_expression(skill.duration, vocabulary) if skill.duration else "",
        cost=format_expression(skill.cost, vocabulary) if skill.cost else "",
        flags=list(describe_flags(skill)),
        pause=describe_pause(skill.pause),
        implementations=[
            (each, _difference(each, skill, vocabulary), _body(each)) for each in library.implementations_of(skill.name)
        ],
    )


def _parameter(parameter: Parameter, vocabulary: Vocabulary) -> tuple[str, ...]:
    """Return the row of a parameter: name, direction, type, default, range, description."""
    kind = KINDS[parameter.direction] + (", any" if parameter.any_ else "")
    number = None if parameter.default is None else constant_number(parameter.default)
    default, low, high = format_quantities((number, parameter.low, parameter.high), parameter.type)
    if parameter.default is not None and number is None:
        default = _default(parameter.default, vocabulary)
    range_ = f"{low} .. {high}" if low or high else ""
    row = (parameter.name, kind, format_type(parameter.type, vocabulary), default, range_, parameter.doc)
    return tuple(each.replace("|", "\\|").replace("\n", " ") for each in row)


def _default(default: Expression, vocabulary: Vocabulary) -> str:
    match default:
        case Literal(value=value):
            return format_literal(value)
        case expression:
            return format_expression(expression, vocabulary)


def _difference(implementation: Implementation, skill: Skill, vocabulary: Vocabulary) -> list[str]:
    """Return what an implementation requires beyond the description, one phrase per item."""
    described = {each.name: each for each in skill.parameters}
    refined = [each for each in implementation.parameters if described.get(each.name) != each]
    own = [
        requirement
        for ours, theirs in ((implementation.pre, skill.pre), (implementation.hold, skill.hold))
        for requirement in ours
        if requirement not in theirs
    ]
    phrases = [f"`{each.name}: {format_type(each.type, vocabulary)}`" for each in refined]
    return phrases + [f"`{each.text}`" for each in own]


def _body(implementation: Implementation) -> str:
    match implementation.body:
        case Compound(node=node):
            names = dict.fromkeys(each.skill for each in find_calls(node))
            return "calls " + ", ".join(f"[{name}]({name}.md)" for name in names) if names else "calls no skill"
        case Primitive(python=python):
            return f"runs `{python}`"
        case Declared():
            return "has no body"
        case _:
            assert_never(implementation.body)


@cache
def _template(name: str) -> Template:
    return open_templates(Path(__file__).parent / "templates").get_template(name)


SMALL = 0.1


FINER = {"Length": "mm", "Time": "ms"}
FAMILIAR = {"Angle": "deg", "AngularSpeed": "deg/s"}


def format_quantities(values: Sequence[float | None], type_: ValueType) -> tuple[str, ...]:
    """Return values (in SI units) as text with a common unit, "" for None.

    Lengths and times have a smaller unit, used if some non-zero value is below 0.1 in SI units.
    """
    dimension = type_.dimension if isinstance(type_, NumberType) else ""
    small = any(each is not None and 0 < abs(each) < SMALL for each in values)
    unit = FAMILIAR.get(dimension) or (FINER.get(dimension) if small else None)
    return tuple("" if each is None else _text(each, type_, unit) for each in values)


def _text(value: float, type_: ValueType, unit: str | None) -> str:
    return format_quantity(value, type_) if unit is None else f"{value / to_si(1.0, unit):g} {unit}"
