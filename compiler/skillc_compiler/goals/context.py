"""The context of a goal or call: the vocabularies, the skills of a library and the individuals of a scene."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from skillc_compiler.program.expressions import TypedExpression
from skillc_compiler.program.typed import Parameter, Skill
from skillc_compiler.program.types import Type, type_of
from skillc_compiler.resolve.conditions import resolve_condition
from skillc_compiler.resolve.homes import Homes
from skillc_compiler.resolve.individuals import Individuals, most_specific_classes
from skillc_compiler.resolve.names import KINDS, Kind, Names, bare_terms
from skillc_compiler.resolve.scope import FileContext
from skillc_dsl.position import Position
from skillc_dsl.source import Span
from skillc_model import skills as library
from skillc_model.conditions import Expression, Literal
from skillc_rdf.vocabulary.types import Vocabulary


def make_context(
    vocabulary: Vocabulary,
    individuals: Individuals,
    prefixes: Mapping[str, str],
    skills: Mapping[str, library.Skill] | None = None,
    home: Sequence[str] = (),
) -> FileContext:
    """Return the context in which a goal is resolved; every unambiguous term may be written without its prefix.

    A bare name means what it means in a library whose own and used namespaces are `home`, if anything.
    `individuals` are the IRIs of the scene with their classes; `prefixes` are allowed in addition to the vocabulary's.
    """
    callees = {name: _skill(skill) for name, skill in (skills or {}).items()}
    names = Names(
        bare=_bare_terms(vocabulary, tuple(home)),
        known={
            "class": set(vocabulary.classes),
            "relation": set(vocabulary.relations),
            "property": set(vocabulary.properties),
        },
        vocabulary=vocabulary,
        prefixes={**prefixes, **vocabulary.prefixes},
        functions=vocabulary.functions,
        skills=set(callees),
        elsewhere=Homes({}, {}, frozenset(), ""),
    )
    return FileContext(
        names=names,
        vocabulary=vocabulary,
        resolve_condition=resolve_condition,
        skills=callees,
        implementations={name: skill.implementations for name, skill in (skills or {}).items()},
        individuals=most_specific_classes(vocabulary, individuals),
    )


def _bare_terms(vocabulary: Vocabulary, home: tuple[str, ...]) -> dict[Kind, dict[str, tuple[str, ...]]]:
    """Return the terms that bare names denote: those of the `home` namespaces, or else of any."""
    known = bare_terms(vocabulary, vocabulary.prefixes)
    own = bare_terms(vocabulary, (prefix for prefix, base in vocabulary.prefixes.items() if base in home))
    return {kind: {**known[kind], **own[kind]} for kind in KINDS}


def _skill(skill: library.Skill) -> Skill:
    """Return a compiled skill as the resolved skill that calls refer to."""
    return Skill(
        name=skill.name,
        doc=skill.doc,
        parameters=tuple(_parameter(p) for p in skill.parameters),
        requirements=(),
        senses=(),
        duration=None,
        cost=None,
        devices=(),
        pause=None,
        flags=frozenset({"scoped"}) if skill.scoped else frozenset(),
        name_span=_span(skill.source),
        span=_span(skill.source),
    )


def _parameter(parameter: library.Parameter) -> Parameter:
    kind, span = type_of(parameter.type), _span(parameter.source)
    return Parameter(
        name=parameter.name,
        direction=parameter.direction,
        any_=parameter.any_,
        declared=parameter.type,
        type=kind,
        default=_valued(parameter.default, kind, span),
        low=_valued(None if parameter.low is None else Literal(parameter.low), kind, span),
        high=_valued(None if parameter.high is None else Literal(parameter.high), kind, span),
        doc=parameter.doc,
        span=span,
    )


def _valued(meaning: Expression | None, kind: Type, span: Span) -> TypedExpression | None:
    return TypedExpression(meaning, kind, span) if meaning is not None else None


def _span(place: Position) -> Span:
    return Span(place.path, place.line, place.column, place.line, place.column + 1)
