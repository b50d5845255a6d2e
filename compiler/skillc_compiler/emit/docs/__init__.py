"""docs/: a page per skill and one that lists them, in Markdown."""

from __future__ import annotations

from functools import cache

from jinja2 import Environment, PackageLoader, StrictUndefined, Template

from skillc_compiler.emit.quantities import quantity_texts
from skillc_model.conditions import Expression, Literal
from skillc_model.format_condition import format_expression, format_literal
from skillc_model.reading import calls_in
from skillc_model.rewriting import constant_number
from skillc_model.skills import Compound, Implementation, Parameter, Skill, SkillLibrary
from skillc_model.words import type_text
from skillc_rdf.vocabulary.types import Vocabulary

KINDS = {"in": "required", "opt": "optional", "infer": "inferred", "out": "output"}


def emit(library: SkillLibrary) -> dict[str, str]:
    """Return the pages by path."""
    skills = [skill for _, skill in sorted(library.skills.items())]
    pages = {f"docs/{skill.name}.md": _page(skill, library) for skill in skills}
    return {**pages, "docs/index.md": _template("index.md.j2").render(library=library, skills=skills)}


def _page(skill: Skill, library: SkillLibrary) -> str:
    vocabulary = library.vocabulary
    conditions = [("Preconditions", skill.pre), ("Holds while running", skill.hold), ("Postconditions", skill.post)]
    return _template("skill.md.j2").render(
        skill=skill,
        parameters=[_parameter(each, vocabulary) for each in skill.parameters],
        conditions=[(title, listed) for title, listed in conditions if listed],
        duration=format_expression(skill.duration, vocabulary) if skill.duration else "",
        implementations=[
            (each, _difference(each, skill, vocabulary), _body(each)) for each in library.implementations_of(skill.name)
        ],
    )


def _parameter(parameter: Parameter, vocabulary: Vocabulary) -> tuple[str, ...]:
    """Return the row of a parameter: name, kind, type, default, range, what it is."""
    kind = KINDS[parameter.direction] + (", any" if parameter.any_ else "")
    number = None if parameter.default is None else constant_number(parameter.default)
    default, low, high = quantity_texts((number, parameter.low, parameter.high), parameter.type)
    if parameter.default is not None and number is None:
        default = _default(parameter.default, vocabulary)
    range_ = f"{low} .. {high}" if low or high else ""
    row = (parameter.name, kind, type_text(parameter.type, vocabulary), default, range_, parameter.doc)
    return tuple(each.replace("|", "\\|").replace("\n", " ") for each in row)


def _default(default: Expression, vocabulary: Vocabulary) -> str:
    match default:
        case Literal(value=value):
            return format_literal(value)
        case expression:
            return format_expression(expression, vocabulary)


def _difference(implementation: Implementation, skill: Skill, vocabulary: Vocabulary) -> list[str]:
    """Return what an implementation demands beyond the description, a phrase each."""
    described = {each.name: each for each in skill.parameters}
    refined = [each for each in implementation.parameters if described.get(each.name) != each]
    own = [
        requirement
        for ours, theirs in ((implementation.pre, skill.pre), (implementation.hold, skill.hold))
        for requirement in ours
        if requirement not in theirs
    ]
    phrases = [f"`{each.name}: {type_text(each.type, vocabulary)}`" for each in refined]
    return phrases + [f"`{each.text}`" for each in own]


def _body(implementation: Implementation) -> str:
    match implementation.body:
        case Compound(node=node):
            names = dict.fromkeys(each.skill for each in calls_in(node))
            return "calls " + ", ".join(f"[{name}]({name}.md)" for name in names) if names else "calls no skill"
        case primitive:
            return f"runs `{primitive.python}`"


@cache
def _template(name: str) -> Template:
    environment = Environment(
        loader=PackageLoader("skillc_compiler.emit.docs", "templates"),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,
    )
    return environment.get_template(name)
