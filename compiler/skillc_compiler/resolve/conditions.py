"""Resolving conditions: relations, properties and classes are looked up, both sides are typed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import assert_never

from skillc_compiler.program.expressions import EffectScope, TypedCondition, TypedExpression
from skillc_compiler.program.types import BOOL, UNKNOWN, Thing, fits
from skillc_compiler.program.unknown import UnknownName
from skillc_compiler.resolve.called_conditions import (
    report_called_condition,
    report_compared_by_is,
    report_equals,
    report_relation_first,
)
from skillc_compiler.resolve.comparisons import is_local, resolve_comparison
from skillc_compiler.resolve.links import say_of
from skillc_compiler.resolve.references import ExpectedType, to_term
from skillc_compiler.resolve.scope import FileContext, LocalName, Scope
from skillc_compiler.resolve.values import resolve_property, resolve_value
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Fix, Label
from skillc_dsl.source import Span
from skillc_model.conditions import (
    And,
    Anything,
    Compare,
    Exists,
    Forall,
    Given,
    HasProperty,
    Holds,
    IsA,
    Literal,
    Not,
    Or,
)
from skillc_model.conditions import Variable as VariableTerm
from skillc_rdf.vocabulary.types import THING


def resolve_condition(context: FileContext, scope: Scope, written: s.Condition) -> TypedCondition:
    """Return the typed condition; unresolved parts are reported."""
    match written:
        case s.Relation():
            return _resolve_relation(context, scope, written)
        case s.Compare() | s.Change():
            return resolve_comparison(context, scope, written)
        case s.Has():
            return _resolve_has(context, scope, written)
        case s.Is():
            return _resolve_is(context, scope, written)
        case s.Given(parameter=name, span=span):
            return _resolve_given(context, scope, name, span)
        case s.Not(body=body, span=span):
            return _not(resolve_condition(context, scope, body), span)
        case s.And(parts=parts, span=span):
            conditions = tuple(resolve_condition(context, scope, part) for part in parts)
            return TypedCondition(And(tuple(c.meaning for c in conditions)), span, parts=conditions)
        case s.Or(parts=parts, span=span):
            return _or([resolve_condition(context, scope, part) for part in parts], span)
        case s.Implies(if_=if_, then=then, span=span):
            premise = resolve_condition(context, scope, if_)
            return _or([_not(premise, premise.span), resolve_condition(context, scope, then)], span)
        case s.Quantified():
            return _resolve_quantified(context, scope, written)
        case s.Bare():
            return _resolve_bare(context, scope, written)
        case _:
            assert_never(written)


def _resolve_has(context: FileContext, scope: Scope, written: s.Has) -> TypedCondition:
    of = resolve_value(context, scope, written.subject)
    iri = resolve_property(context, of, written.property) or written.property.text

    def has(things: Sequence[TypedExpression]) -> TypedCondition:
        if iri in context.vocabulary.relations:
            anything = TypedExpression(VariableTerm("_"), UNKNOWN, written.property.span)
            return TypedCondition(
                Holds(to_term(context, things[0]), iri, Anything()), written.span, (*things, anything)
            )
        return TypedCondition(HasProperty(to_term(context, things[0]), iri), written.span, tuple(things))

    return say_of(context, scope, (of,), has)


def _resolve_is(context: FileContext, scope: Scope, written: s.Is) -> TypedCondition:
    if report_compared_by_is(context, written.subject, written.cls):
        return TypedCondition(And(()), written.span)
    of = resolve_value(context, scope, written.subject, ExpectedType(Thing(None)))
    cls = _look_up_class(context, written.cls)

    def is_a(things: Sequence[TypedExpression]) -> TypedCondition:
        return TypedCondition(IsA(to_term(context, things[0]), cls), written.span, tuple(things))

    return say_of(context, scope, (of,), is_a)


def _not(body: TypedCondition, span: Span) -> TypedCondition:
    return TypedCondition(Not(body.meaning), span, parts=(body,))


def _or(parts: Sequence[TypedCondition], span: Span) -> TypedCondition:
    return TypedCondition(Or(tuple(part.meaning for part in parts)), span, parts=tuple(parts))


def _resolve_relation(context: FileContext, scope: Scope, written: s.Relation) -> TypedCondition:
    name = _relation_in_place_of_subject(context, scope, written)
    if name is not None:
        report_relation_first(context, scope, name, written)
        return TypedCondition(And(()), written.span)
    if report_equals(context, written.relation):
        return TypedCondition(And(()), written.span)
    subject = _resolve_side(context, scope, written.subject)
    object_ = _resolve_object(context, scope, written)
    iri = _look_up_relation(context, written.relation, subject, object_)

    def holds(things: Sequence[TypedExpression]) -> TypedCondition:
        terms = (to_term(context, each) for each in things)
        return TypedCondition(
            Holds(next(terms), iri or written.relation.text, next(terms)), written.span, tuple(things)
        )

    return say_of(context, scope, (subject, object_), holds)


def _relation_in_place_of_subject(context: FileContext, scope: Scope, written: s.Relation) -> s.Name | None:
    """Return the name of a relation that stands where its subject should be, as in `post tightIn one`, or None."""
    match written.subject:
        case s.NameReference(name=name) if name.text not in scope.variables:
            return name if context.names.is_term("relation", name.text) else None
    return None


def _resolve_object(context: FileContext, scope: Scope, written: s.Relation) -> TypedExpression:
    """Resolve the object; beside a relation between unknown classes, a bare name may be anything."""
    iris = context.names.bare["relation"].get(written.relation.text, ())
    known = [term for iri in iris if (term := context.vocabulary.relations.get(iri)) is not None]
    match written.object:
        case s.NameReference(name=s.Name(text=text), span=span) if known and not any(each.signatures for each in known):
            if not is_local(scope, written.object):
                return TypedExpression(VariableTerm(text), UNKNOWN, span)
    return _resolve_side(context, scope, written.object, _closed_range(context, written.relation))


def _closed_range(context: FileContext, name: s.Name) -> str | None:
    """Return the enumeration to which a relation leads, None if it leads elsewhere."""
    vocabulary = context.vocabulary
    terms = (vocabulary.relations.get(iri) for iri in context.names.bare["relation"].get(name.text, ()))
    ranges = {each.range for term in terms if term is not None for each in term.signatures}
    return next(iter(ranges & vocabulary.enumerations.keys()), None) if len(ranges) == 1 else None


def _resolve_side(
    context: FileContext, scope: Scope, written: s.Value | s.Anything, cls: str | None = None
) -> TypedExpression:
    if isinstance(written, s.Anything):
        return TypedExpression(VariableTerm("_"), UNKNOWN, written.span)
    return resolve_value(context, scope, written, ExpectedType(Thing(cls)))


def _look_up_relation(
    context: FileContext, name: s.Name, subject: TypedExpression, object_: TypedExpression
) -> str | None:
    """Return the IRI of a relation; nothing is said of it if a side is erroneous, as the words may be swapped."""
    names, vocabulary = context.names, context.vocabulary
    if not names.is_term("relation", name.text) and (_is_erroneous(subject) or _is_erroneous(object_)):
        return None
    if names.is_term("property", name.text) and not names.is_term("relation", name.text):
        context.report(
            "unknown-relation",
            name.span,
            f"`{name.text}` is a property with a value, not a relation between individuals",
            f"compare its value: `a.{name.text} == ..`",
        )
        return None
    return names.look_up_term(
        "relation",
        name,
        lambda iri: any(
            fits(vocabulary, subject.type, Thing(signature.domain))
            and fits(vocabulary, object_.type, Thing(signature.range))
            for signature in vocabulary.relations[iri].signatures
        ),
    )


def _is_erroneous(side: TypedExpression) -> bool:
    return side.type == UNKNOWN and side.meaning != VariableTerm("_")


def _look_up_class(context: FileContext, name: s.Name) -> str:
    return context.names.look_up_term("class", name) or name.text


def _resolve_given(context: FileContext, scope: Scope, name: s.Name, span: Span) -> TypedCondition:
    known = scope.variables.get(name.text)
    if known is not None and known.origin == "out":
        message = f"`{name.text}` is an output, which is never passed"
        label = Label(known.span, "declared here", is_cause=True)
        context.report("out-unassigned", name.span, message, "declare it with `opt`", label)
    elif known is None or known.origin != "parameter":
        parameters = tuple(n for n, v in scope.variables.items() if v.origin == "parameter")
        message, help_ = f"{scope.owner} has no parameter `{name.text}`", "declare it with `opt`"
        context.report_unknown(UnknownName("parameter", name, message, parameters, help_, owner=scope.skill))
    return TypedCondition(Given(name.text), span)


def _resolve_quantified(context: FileContext, scope: Scope, written: s.Quantified) -> TypedCondition:
    iri = context.names.look_up_term("class", written.cls)
    kind = (Thing(None) if iri == THING else Thing(iri)) if iri else UNKNOWN
    inner = context.bind(scope, written.variable, LocalName(kind, "variable", written.variable.span))
    body = resolve_condition(context, inner, written.body)
    if written.when is not None:
        if written.quantifier == "exists":
            message, help_ = "`when` says which individuals an effect is on", "write `forall`, or join it by `and`"
            context.report("misplaced-when", written.when.span, message, help_)
        when = resolve_condition(context, inner, written.when)
        effect = EffectScope(written.variable.text, iri or THING)
        return TypedCondition(And(()), written.span, parts=(body, when), conditional=effect)
    quantifier = Exists if written.quantifier == "exists" else Forall
    return TypedCondition(quantifier(written.variable.text, iri or THING, body.meaning), written.span, parts=(body,))


def _resolve_bare(context: FileContext, scope: Scope, written: s.Bare) -> TypedCondition:
    """Resolve a value that stands as a condition: report it, with the comparison to write if it is a truth value."""
    if report_called_condition(context, written.value):
        return TypedCondition(And(()), written.span)
    of = resolve_value(context, scope, written.value)
    span = written.span
    if of.type == BOOL:
        fix = Fix(span.after, " == true", "compare it with `true`")
        context.names.problems.append(
            Diagnostic("not-a-condition", span, "a value is not a condition", "write `.. == true`", fix=fix)
        )
    elif of.type != UNKNOWN:
        is_text = isinstance(written.value, s.Text)
        help_ = "write the condition without quotation marks" if is_text else "compare it: `.. == ..`, `.. < ..`"
        context.report("not-a-condition", span, "a value is not a condition", help_)
    return TypedCondition(Compare(of.meaning, "==", Literal(True)), span, (of,))
