"""Names in expressions: what each means, and what is expected where it stands."""

from __future__ import annotations

import msgspec

from skillc_compiler.program.expressions import TypedExpression
from skillc_compiler.program.labels import label_declaration, label_values
from skillc_compiler.program.types import (
    TEXT,
    UNKNOWN,
    Thing,
    Type,
    fits,
)
from skillc_compiler.program.unknown import LIBRARY, UnknownName
from skillc_compiler.resolve.called_conditions import MISSING, NOTHING
from skillc_compiler.resolve.scope import FileContext, Scope
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Label
from skillc_model.conditions import (
    Anything,
    Individual,
    Literal,
    PropertyOf,
    Term,
    Variable,
)
from skillc_rdf.vocabulary.types import local_name, value_name


class ExpectedType(msgspec.Struct, frozen=True):
    """The type expected of an expression: suggestions fit it, and a bare name may be one of `values`."""

    type: Type = UNKNOWN
    values: tuple[str, ...] = ()


ANYTHING = ExpectedType()


def resolve_reference(
    context: FileContext, scope: Scope, written: s.NameReference, wanted: ExpectedType
) -> TypedExpression:
    """Return what a name means: a parameter or variable, an individual, or a value that is expected; else report it."""
    text, span = written.name.text, written.span
    if ":" in text:
        return _resolve_individual(context, written, wanted)
    known = scope.variables.get(text)
    if known is not None:
        if not known.is_assigned:
            context.report(
                "out-unassigned",
                span,
                f"`{text}` is an output, which has no value before the skill has run",
                "declare it with `in`, or read it in a `post`",
                Label(known.span, "declared here", is_cause=True),
            )
        return TypedExpression(Variable(text), known.type, span, declared=known.span)
    if text in wanted.values:
        return TypedExpression(Literal(text), TEXT, span)
    enumeration = wanted.type.cls if isinstance(wanted.type, Thing) else None
    value = context.vocabulary.find_value(enumeration, text)
    if value is not None:
        return TypedExpression(Individual(value), wanted.type, span)
    if wanted.values:
        report_unknown_value(context, written.name, wanted)
    else:
        _unknown_name(context, scope, written, wanted)
    return TypedExpression(Variable(text), UNKNOWN, span)


def report_unknown_value(context: FileContext, name: s.Name, wanted: ExpectedType) -> None:
    """Report a name that is not one of the values of a property."""
    message = f"`{name.text}` is not a value of this property"
    help_ = f"it is {' or '.join(wanted.values)}"
    context.report_unknown(UnknownName("value", name, message, tuple(wanted.values), help_))


def _unknown_name(context: FileContext, scope: Scope, written: s.NameReference, wanted: ExpectedType) -> None:
    name, cls = written.name.text, wanted.type.cls if isinstance(wanted.type, Thing) else None
    if cls in context.vocabulary.enumerations:
        values = tuple(map(value_name, context.vocabulary.enumerations[cls]))
        message, help_ = f"`{name}` is not a value of `{local_name(cls)}`", f"it is {' or '.join(values)}"
        labels = label_declaration(context.vocabulary.classes[cls])
        context.report_unknown(UnknownName("value", written.name, message, values, help_, labels, owner=LIBRARY))
        return
    fitting = [n for n, v in scope.variables.items() if fits(context.vocabulary, v.type, wanted.type)]
    otherwise = "an individual is written with its prefix: `lab:Board-1`"
    if name in NOTHING:
        fitting, otherwise = [], MISSING
    elif context.names.is_term("class", name):
        fitting, otherwise = [], f"`{name}` is a class: write `a is {name}`"
    elif name == "any":
        fitting, otherwise = [], "write `_` for any individual"
    context.report_unknown(
        UnknownName(
            "parameter",
            written.name,
            f"{scope.owner} has no parameter or other name `{name}`",
            tuple(fitting),
            otherwise,
            owner=scope.skill,
            repeats=scope.repeats,
        )
    )


def _resolve_individual(context: FileContext, written: s.NameReference, wanted: ExpectedType) -> TypedExpression:
    iri = context.names.look_up_individual(written.name)
    if iri is None:
        return TypedExpression(Individual(written.name.text), UNKNOWN, written.span)
    kind = context.names.kind_of(iri)
    if kind is not None:
        context.report(
            "not-an-individual",
            written.span,
            f"`{written.name.text}` is a {kind}, where an individual or a value is expected",
            "write a parameter, or an individual of the scene",
        )
        return TypedExpression(Individual(iri), UNKNOWN, written.span)
    return TypedExpression(Individual(iri), _class_of(context, written, iri, wanted), written.span)


def _class_of(context: FileContext, written: s.NameReference, iri: str, wanted: ExpectedType) -> Type:
    """Return the type of an individual; one that the scene does not have is reported."""
    known = context.individuals
    if known is None:
        return Thing(None)
    if iri in known:
        return Thing(known[iri])
    fitting = [other for other, cls in known.items() if fits(context.vocabulary, Thing(cls), wanted.type)]
    message = f"there is no `{written.name.text}` in the scene"
    candidates = tuple(context.names.shorten(each) for each in fitting)
    context.report_unknown(UnknownName("individual", written.name, message, candidates))
    return UNKNOWN


def expect_beside(context: FileContext, other: TypedExpression) -> ExpectedType:
    """Return what is expected of a value that is compared with another one."""
    match other.meaning:
        case PropertyOf(property=iri) if iri in context.vocabulary.properties:
            return ExpectedType(other.type, context.vocabulary.properties[iri].values)
        case Variable() | Individual():
            closed = isinstance(other.type, Thing) and other.type.cls in context.vocabulary.enumerations
            return ExpectedType(Thing(None) if isinstance(other.type, Thing) and not closed else other.type)
    return ANYTHING if other.type == UNKNOWN else ExpectedType(other.type)


def to_term(context: FileContext, of: TypedExpression) -> Term:
    """Return the individual that a value denotes; anything else is reported and replaced by `_`."""
    match of.meaning:
        case Variable(name="_"):
            return Anything()
        case Variable() | Individual() as term if isinstance(of.type, Thing) or of.type == UNKNOWN:
            return term
    if of.type != UNKNOWN:
        context.report(
            "not-an-individual",
            of.span,
            "a relation, `has` or `is` is about individuals, and this is a value",
            "write a parameter of an ontology class, or an individual; values are compared with `==`, `<`, ..",
            *label_values(of),
        )
    return Anything()
