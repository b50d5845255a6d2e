"""Pages in Markdown that describe the terms of a vocabulary."""

from __future__ import annotations

import math
from collections.abc import Sequence

from skillc_compiler.resolve.names import Kind
from skillc_dsl.units import DIMENSIONS, UNITS, dimension_of, to_si
from skillc_model.format_type import SI_UNITS
from skillc_rdf.vocabulary.types import (
    THING,
    ClassTerm,
    ClassType,
    DirectionType,
    FunctionTerm,
    ListType,
    NumberType,
    PlainType,
    PropertyTerm,
    RelationTerm,
    ValueType,
    VectorType,
    Vocabulary,
    local_name,
    value_name,
)

ABOUT = {
    "Vector": ": three numbers along the axes of the world, pure ones or of a dimension: `Vector of Length`",
    "Direction": ": a vector of pure numbers along the axes of the world, of length 1",
    "Message": ": a text in which `{name}` stands for the value of that name where it is written",
}
"""The descriptions of the types that have no units."""


FAILURE = {
    "kind": "what kind of failure it is, a Text: `pre`, `hold`, `post`, `timeout`, `space`, `body`, ..",
    "message": "the message of the failure, a Text",
    "skill": "the innermost skill that failed, a Text",
    "source": "the line of the innermost skill that failed, a Text",
}
"""What is told of a failure, by the name after the `.`."""


AGGREGATE_FORMS = {
    "count": "count(x: Class where C)",
    **{name: f"{name}(x: Class where C, VALUE)" for name in ("sum", "min", "max", "mean")},
}
"""The functions of the individuals of a class, with how each is written."""
_AGGREGATES = {
    "count": "how many individuals of the class there are of which the condition holds",
    "sum": "the sum of the value of each individual of which the condition holds; 0 if there are none",
    "min": "the least value of the individuals of which the condition holds; of none there is none",
    "max": "the greatest value of the individuals of which the condition holds; of none there is none",
    "mean": "the mean of the values of the individuals of which the condition holds; of none there is none",
}


def describe_aggregate(name: str) -> str:
    """Return the page of a function of the individuals of a class; empty for any other name."""
    return format_page(AGGREGATE_FORMS[name], _AGGREGATES[name]) if name in AGGREGATE_FORMS else ""


def term_page(vocabulary: Vocabulary, kind: Kind, iri: str, bounds: str = "") -> str:
    """Return the page of a class, relation or property, or an empty string for an unknown one.

    `bounds` says in which range a property is.
    """
    match kind:
        case "class" if iri == THING:
            return format_page("class Thing", "Everything there is.")
        case "class" if iri in vocabulary.classes:
            return _class(vocabulary, vocabulary.classes[iri])
        case "relation" if iri in vocabulary.relations:
            return _relation(vocabulary, vocabulary.relations[iri])
        case "property" if iri in vocabulary.properties:
            return _property(vocabulary, vocabulary.properties[iri], bounds)
        case _:
            return ""


def type_page(name: str) -> str:
    """Return the page of a type that is not a class, with its units."""
    units = [unit for unit, other in UNITS.items() if name in DIMENSIONS and other.dimension == DIMENSIONS[name]]
    known = f", in {', '.join(f'`{unit}`' for unit in units)}" if units else ABOUT.get(name, "")
    return f"the type **{name}**{known}"


def function_page(term: FunctionTerm) -> str:
    """Return the page of a function."""
    return format_page(format_function_head(term), term.comment, f"Python: `{term.python}`")


def format_function_head(term: FunctionTerm) -> str:
    """Return the declaration of a function without its Python name."""
    parameters = ", ".join(f"{name}: {format_bare_type(kind)}" for name, kind in term.parameters)
    return f"function {term.name}({parameters}) -> {format_bare_type(term.result)}"


def choice_page(vocabulary: Vocabulary, text: str, iri: str = "") -> str:
    """Return the page of a value: its enumeration, or for an unknown one all that have it, and text properties."""
    if iri in vocabulary.enumerated:
        home = vocabulary.enumerated[iri]
        values = ", ".join(map(value_name, vocabulary.enumerations[home]))
        return f"`{text}`: a value of {format_names([home])}: {values}\n\n`{vocabulary.short(iri)}`"
    homes = {iri: tuple(map(value_name, values)) for iri, values in sorted(vocabulary.enumerations.items())}
    homes |= {iri: term.values for iri, term in sorted(vocabulary.properties.items())}
    return "\n\n".join(
        f"`{text}`: a value of {format_names([iri])}: {', '.join(values)}"
        for iri, values in homes.items()
        if text in values
    )


def format_bare_type(kind: ValueType) -> str:
    """Return a type in the syntax of the language."""
    match kind:
        case ClassType(iri=iri):
            return local_name(iri)
        case NumberType(dimension=name):
            return name
        case VectorType(dimension=dimension):
            return "Vector" if dimension == "Number" else f"Vector of {dimension}"
        case DirectionType():
            return "Direction"
        case PlainType(name=name):
            return name
        case ListType(element=element):
            return f"[{format_bare_type(element)}]"


def quantity_page(value: float, unit: str) -> str:
    """Return the page of a quantity: its dimension and its value in SI units."""
    dimension = dimension_of(unit)
    written = f"{value:g} {unit}"
    other = f"{to_si(value, unit):.6g} {SI_UNITS[dimension.name]}"
    degrees = f" ({math.degrees(to_si(value, unit)):.4g} deg)" if unit == "rad" else ""
    return f"**{dimension.name}** `{written}`" + (f" = `{other}`" if other != written else "") + degrees


def format_page(code: str, *paragraphs: str) -> str:
    """Return a block of code followed by paragraphs."""
    return "\n\n".join((f"```skill\n{code}\n```", *(text for text in paragraphs if text)))


def format_names(iris: Sequence[str]) -> str:
    """Return the local names of terms, sorted."""
    return ", ".join(f"`{local_name(iri)}`" for iri in sorted(iris))


def _class(vocabulary: Vocabulary, term: ClassTerm) -> str:
    parents = f" < {_names(term.parents)}" if term.parents else ""
    below = [iri for iri, other in vocabulary.classes.items() if term.iri in other.parents]
    values = ", ".join(map(value_name, vocabulary.enumerations.get(term.iri, ())))
    name = local_name(term.iri)
    return format_page(
        f"enum {name} {{ {values} }}" if values else f"class {name}{parents}",
        term.comment,
        f"disjoint with `{_names(term.disjoint)}`" if term.disjoint else "",
        f"subclasses: {format_names(below)}" if below else "",
        f"`{vocabulary.short(term.iri)}`",
    )


def _relation(vocabulary: Vocabulary, term: RelationTerm) -> str:
    name = local_name(term.iri)
    heads = [f"relation {name}({local_name(x.domain)}, {local_name(x.range)})" for x in term.signatures]
    traits = {"functional": term.functional, "symmetric": term.symmetric, "transitive": term.transitive}
    return format_page(
        "\n".join(heads) or f"relation {name}",
        term.comment,
        ", ".join(trait for trait, has in traits.items() if has),
        f"inverse of `{local_name(term.inverse)}`" if term.inverse else "",
        f"implies `{_names(term.parents)}`" if term.parents else "",
        _origin(vocabulary, term),
        f"`{vocabulary.short(term.iri)}`",
    )


def _origin(vocabulary: Vocabulary, term: RelationTerm) -> str:
    definition = vocabulary.definitions.get(term.iri)
    if definition is None:
        return f"computed by `{term.computed_by}`" if term.computed_by else ""
    sides = f"{definition.subject.name} {local_name(term.iri)} {definition.object.name}"
    return f"`{sides}` is defined as `{definition.text}`"


def _property(vocabulary: Vocabulary, term: PropertyTerm, bounds: str) -> str:
    name = local_name(term.iri)
    heads = [f"property {name}({local_name(domain)}): {format_bare_type(term.type)}" for domain in term.domains]
    return format_page(
        "\n".join(heads) or f"property {name}: {format_bare_type(term.type)}",
        term.comment,
        bounds,
        f"one of {', '.join(f'`{value}`' for value in term.values)}" if term.values else "",
        f"computed by `{term.computed_by}`" if term.computed_by else "",
        f"judged from `{local_name(term.measure)}`" if term.measure else "",
        f"needs `{local_name(term.threshold)}`" if term.threshold else "",
        f"`{vocabulary.short(term.iri)}`",
    )


def _names(iris: Sequence[str]) -> str:
    return ", ".join(local_name(iri) for iri in iris)
