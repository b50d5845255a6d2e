"""The contents of a skill's page."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import TypeAlias

import msgspec
from markupsafe import Markup

from skillc_compiler.emit.docs import prose
from skillc_compiler.emit.docs.linking import LinkWriter
from skillc_compiler.emit.docs.listing import format_excerpt
from skillc_compiler.emit.docs.mentions import find_called_skills, find_terms
from skillc_compiler.emit.docs.traits import describe_flags, describe_pause
from skillc_compiler.emit.docs.written import WrittenDeclarations
from skillc_compiler.emit.picture import svg
from skillc_compiler.emit.picture.drawing import draw_implementation
from skillc_dsl import syntax as s
from skillc_model.format_type import format_type
from skillc_model.skills import Implementation, Outcome, Parameter, Post, Primitive, Requirement, Skill, SkillLibrary
from skillc_rdf.vocabulary.types import ClassType, Vocabulary, local_name

COLUMNS = ("name", "kind", "type", "default", "range", "what it is")
Row: TypeAlias = tuple[str, Markup, str, Markup]
"""A condition: label, text, remark, link to the source."""
KINDS = {"in": "required", "opt": "optional", "infer": "inferred", "out": "output"}


class Way(msgspec.Struct, frozen=True):
    """An implementation: its name, documentation, reason for its rank, picture, text and called skills."""

    name: str
    doc: Markup
    why: Markup
    place: Markup
    python: str
    picture: Markup
    text: Markup
    calls: tuple[Markup, ...]


class SkillPage(msgspec.Struct, frozen=True):
    """A skill; `columns` are the headings of the rows in `parameters`."""

    name: str
    doc: Markup
    place: Markup
    traits: tuple[Markup, ...]
    columns: tuple[str, ...]
    parameters: tuple[tuple[Markup, ...], ...]
    conditions: tuple[tuple[str, tuple[Row, ...]], ...]
    ways: tuple[Way, ...]
    callers: tuple[Markup, ...]
    terms: tuple[Markup, ...]


def skill_page(skill: Skill, library: SkillLibrary, written: WrittenDeclarations, links: LinkWriter) -> SkillPage:
    """Return the contents of a skill's page."""
    declared = written.skills[skill.name]
    ranked = library.implementations_of(skill.name)
    why = reasons(ranked, library.vocabulary)
    terms = frozenset[str]().union(*map(find_terms, (skill, *ranked)))
    return SkillPage(
        skill.name,
        prose.block(skill.doc),
        links.source(skill.source),
        tuple(_traits(skill, declared, written)),
        *_parameters(skill, declared, written, links),
        _conditions(skill, links),
        tuple(_way(each, reason, written, links) for each, reason in zip(ranked, why, strict=True)),
        tuple(links.skill(name) for name in _callers(skill.name, library)),
        tuple(links.term(name) for name in sorted(terms, key=lambda name: (local_name(name).lower(), name))),
    )


def _traits(skill: Skill, declared: s.SkillDeclaration, written: WrittenDeclarations) -> list[Markup]:
    durations = (each for each in declared.members if isinstance(each, s.Duration))
    said = [
        *(f"takes `{written.words(each.value.span)}`" for each in durations),
        *(f"locks `{name}`" for name in skill.uses),
        *(f"adds to the motion of `{name}`" for name in skill.shares),
        *(f"{sentence[0].lower()}{sentence[1:-1]}" for sentence in describe_flags(skill)),
        *filter(None, [describe_pause(skill.pause)]),
    ]
    return [prose.line(each) for each in said]


def _parameters(
    skill: Skill, declared: s.SkillDeclaration, written: WrittenDeclarations, links: LinkWriter
) -> tuple[tuple[str, ...], tuple[tuple[Markup, ...], ...]]:
    """Return the headings of the columns that are not empty, and the cells of each row."""
    as_written = {each.name.text: each for each in declared.members if isinstance(each, s.Parameter)}
    rows = [_parameter(each, as_written.get(each.name), written, links) for each in skill.parameters]
    filled = [index for index in range(len(COLUMNS)) if any(row[index] for row in rows)]
    return tuple(COLUMNS[index] for index in filled), tuple(tuple(row[index] for index in filled) for row in rows)


def _parameter(
    parameter: Parameter, declared: s.Parameter | None, written: WrittenDeclarations, links: LinkWriter
) -> tuple[Markup, ...]:
    """Return the cells of all columns; what `pre of` takes over is declared elsewhere, without default and range."""
    default = written.words(declared.default.span) if declared and declared.default else ""
    bounds = declared.range if declared else None
    range_ = f"{written.words(bounds.low.span)} .. {written.words(bounds.high.span)}" if bounds else ""
    kind = KINDS[parameter.direction] + (", any of several" if parameter.any_ else "")
    return (
        Markup("<code>{}</code>").format(parameter.name),
        Markup.escape(kind),
        links.type(parameter.type),
        links.code(default, ()) if default else Markup(""),
        links.code(range_, ()) if range_ else Markup(""),
        prose.line(parameter.doc),
    )


def _conditions(skill: Skill, links: LinkWriter) -> tuple[tuple[str, tuple[Row, ...]], ...]:
    after = tuple(_condition(post, "measured" if post.sensed else "", links) for post in skill.post)
    before, during = (tuple(_condition(each, "", links) for each in kind) for kind in (skill.pre, skill.hold))
    one = tuple(_condition(each, f"{100.0 * each.likely:.3g} %", links) for each in skill.outcomes)
    groups = (
        ("Must hold when it starts", before),
        ("Must hold while it runs", during),
        ("Holds afterwards", after),
        ("May hold afterwards", tuple(_condition(each, "", links) for each in skill.possible)),
        ("One of them comes true, which is sensed", one),
    )
    return tuple(group for group in groups if group[1])


def _condition(condition: Requirement | Post | Outcome, remark: str, links: LinkWriter) -> Row:
    return (condition.label, links.code(condition.text, find_terms(condition)), remark, links.line(condition.source))


def _way(implementation: Implementation, reason: str, written: WrittenDeclarations, links: LinkWriter) -> Way:
    declared = written.implementations[f"{implementation.skill}.{implementation.name}"]
    source, body = written.source(declared.span), implementation.body
    return Way(
        implementation.name,
        prose.block(implementation.doc),
        prose.line(reason),
        links.source(implementation.source),
        body.python if isinstance(body, Primitive) else "",
        Markup(svg.draw(draw_implementation(declared, source), links.page)),
        format_excerpt(source, declared.span.line, declared.span.end_line),
        tuple(links.skill(name) for name in find_called_skills(implementation)),
    )


def _callers(name: str, library: SkillLibrary) -> list[str]:
    """Return the skills with an implementation that calls this one."""
    return sorted({each.skill for each in library.implementations.values() if name in find_called_skills(each)})


def reasons(ranked: Sequence[Implementation], vocabulary: Vocabulary) -> tuple[str, ...]:
    """Return for each implementation, in rank order, why it ranks before the next, as Markdown."""
    if len(ranked) == 1:
        return ("The only one in this library.",)
    return (*(_before(one, other, vocabulary) for one, other in pairwise(ranked)), "Tried last.") if ranked else ()


def _before(one: Implementation, other: Implementation, vocabulary: Vocabulary) -> str:
    apart = [p for p, q in _classes(one, other) if vocabulary.disjoint(p[1], q[1])]
    if apart:
        return f"Never competes with `{other.name}`: no `{apart[0][0]}` fits both."
    narrower = [p[0] for p, q in _classes(one, other) if p[1] != q[1] and vocabulary.is_a(p[1], q[1])]
    wider = [p for p, q in _classes(one, other) if not vocabulary.is_a(p[1], q[1])]
    if narrower and not wider:
        types = {parameter.name: format_type(parameter.type, vocabulary) for parameter in one.parameters}
        listed = ", ".join(f"`{name}: {types[name]}`" for name in narrower)
        return f"Tried before `{other.name}`, because it is made for fewer cases: {listed}."
    if one.prefer != other.prefer:
        return f"Tried before `{other.name}`, because of `prefer {one.prefer:g}` against `{other.prefer:g}`."
    return f"Tried before `{other.name}`, because it is declared first and neither is made for fewer cases."


def _classes(one: Implementation, other: Implementation) -> list[tuple[tuple[str, str], tuple[str, str]]]:
    """Return the (name, class) pairs, in both implementations, of the parameters that are individuals."""
    return [
        ((p.name, p.type.iri), (q.name, q.type.iri))
        for p, q in zip(one.parameters, other.parameters, strict=True)
        if isinstance(p.type, ClassType) and isinstance(q.type, ClassType)
    ]
