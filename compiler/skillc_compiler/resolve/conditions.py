"""Resolving conditions: relations, properties and classes are looked up, both sides are typed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import assert_never

from skillc_compiler.program.expressions import EffectScope, NumberChange, TypedCondition, TypedExpression
from skillc_compiler.program.labels import label_values
from skillc_compiler.program.types import BOOL, UNKNOWN, Thing, fits
from skillc_compiler.program.unknown import UnknownName
from skillc_compiler.resolve.called_conditions import (
    report_called_condition,
    report_compared_by_is,
    report_equals,
    report_relation_first,
)
from skillc_compiler.resolve.links import compare_links, say_of
from skillc_compiler.resolve.scope import FileContext, LocalName, Scope
from skillc_compiler.resolve.values import ANYTHING, ExpectedType, resolve_property, resolve_value
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
    Individual,
    IsA,
    Literal,
    Not,
    Or,
    PropertyOf,
    Same,
    Term,
)
from skillc_model.conditions import Variable as VariableTerm
from skillc_rdf.vocabulary.types import THING


def resolve_condition(context: FileContext, scope: Scope, written: s.Condition) -> TypedCondition:
    """Return the typed condition; unresolved parts are reported."""
    match written:
        case s.Relation():
            return _resolve_relation(context, scope, written)
        case s.Compare() | s.Change():
            return _resolve_comparison(context, scope, written)
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
                Holds(_to_term(context, things[0]), iri, Anything()), written.span, (*things, anything)
            )
        return TypedCondition(HasProperty(_to_term(context, things[0]), iri), written.span, tuple(things))

    return say_of(context, scope, (of,), has)


def _resolve_is(context: FileContext, scope: Scope, written: s.Is) -> TypedCondition:
    if report_compared_by_is(context, written.subject, written.cls):
        return TypedCondition(And(()), written.span)
    of = resolve_value(context, scope, written.subject, ExpectedType(Thing(None)))
    cls = _look_up_class(context, written.cls)

    def is_a(things: Sequence[TypedExpression]) -> TypedCondition:
        return TypedCondition(IsA(_to_term(context, things[0]), cls), written.span, tuple(things))

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
        terms = (_to_term(context, each) for each in things)
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
            if not _is_local(scope, written.object):
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


def _to_term(context: FileContext, of: TypedExpression) -> Term:
    """Return the individual that a value denotes; anything else is reported and replaced by `_`."""
    match of.meaning:
        case VariableTerm(name="_"):
            return Anything()
        case VariableTerm() | Individual() as term if isinstance(of.type, Thing) or of.type == UNKNOWN:
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


def _look_up_class(context: FileContext, name: s.Name) -> str:
    return context.names.look_up_term("class", name) or name.text


def _resolve_comparison(context: FileContext, scope: Scope, written: s.Compare | s.Change) -> TypedCondition:
    if isinstance(written, s.Change):
        return _resolve_change(context, scope, written)
    return _resolve_compare(context, scope, written)


def _resolve_compare(context: FileContext, scope: Scope, written: s.Compare) -> TypedCondition:
    left, right = _resolve_sides(context, scope, written)
    if written.operator in ("==", "!="):
        linked = compare_links(context, scope, left, right, written.operator == "==", written.span)
        if linked is not None:
            return linked
    individuals = [kind for kind in (left.type, right.type) if isinstance(kind, Thing)]
    if individuals and written.operator in ("==", "!=") and _all_terms(left, right):
        same = TypedCondition(Same(_to_term(context, left), _to_term(context, right)), written.span, (left, right))
        return same if written.operator == "==" else _not(same, written.span)

    def compare(sides: Sequence[TypedExpression]) -> TypedCondition:
        one, other = sides
        return TypedCondition(Compare(one.meaning, written.operator, other.meaning), written.span, (one, other))

    return say_of(context, scope, (left, right), compare)


def _resolve_change(context: FileContext, scope: Scope, written: s.Change) -> TypedCondition:
    of = resolve_value(context, scope, written.property)
    ends = (written.amount, written.amount if written.to is None else written.to)
    low, high = (
        None if isinstance(each, s.Anything) else resolve_value(context, scope, each, _expected_type(context, of))
        for each in ends
    )
    values = tuple(dict.fromkeys(each for each in (of, low, high) if each is not None))
    term = context.vocabulary.properties.get(of.meaning.property) if isinstance(of.meaning, PropertyOf) else None
    change = NumberChange(written.operator, of, low, high, term.bounds if term else None)
    return TypedCondition(And(()), written.span, values, change=change)


def _all_terms(*sides: TypedExpression) -> bool:
    return all(isinstance(side.meaning, VariableTerm | Individual) for side in sides)


def _resolve_sides(context: FileContext, scope: Scope, written: s.Compare) -> tuple[TypedExpression, TypedExpression]:
    """Resolve both sides; the side with the property first, as it determines the values that a bare name may be."""
    if isinstance(written.left, s.NameReference) and not _is_local(scope, written.left):
        right = resolve_value(context, scope, written.right)
        return _resolve_other_side(context, scope, written.left, right), right
    left = resolve_value(context, scope, written.left)
    return left, _resolve_other_side(context, scope, written.right, left)


def _is_local(scope: Scope, written: s.NameReference) -> bool:
    return ":" in written.name.text or written.name.text in scope.variables


def _resolve_other_side(
    context: FileContext, scope: Scope, written: s.Value, known: TypedExpression
) -> TypedExpression:
    """Resolve the side that is compared with `known`; beside an unknown type, a bare name may be anything."""
    match written:
        case s.NameReference(name=s.Name(text=text), span=span) if known.type == UNKNOWN and ":" not in text:
            if text not in scope.variables:
                return TypedExpression(VariableTerm(text), UNKNOWN, span)
        case _:
            pass
    return resolve_value(context, scope, written, _expected_type(context, known))


def _expected_type(context: FileContext, other: TypedExpression) -> ExpectedType:
    match other.meaning:
        case PropertyOf(property=iri) if iri in context.vocabulary.properties:
            return ExpectedType(other.type, context.vocabulary.properties[iri].values)
        case VariableTerm() | Individual():
            closed = isinstance(other.type, Thing) and other.type.cls in context.vocabulary.enumerations
            return ExpectedType(Thing(None) if isinstance(other.type, Thing) and not closed else other.type)
    return ANYTHING if other.type == UNKNOWN else ExpectedType(other.type)


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
