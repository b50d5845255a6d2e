"""Understanding conditions: relations, properties and classes looked up, sides typed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import assert_never

from skillc_compiler.library.conditions import (
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
from skillc_compiler.library.conditions import Variable as VariableTerm
from skillc_compiler.library.vocabulary import THING
from skillc_compiler.program.typed import Clause, Valued
from skillc_compiler.program.types import BOOL, UNKNOWN, Thing, Type, fits
from skillc_compiler.resolve.scope import Scope, Setting, Variable
from skillc_compiler.resolve.values import ANYTHING, Wanted, property_of, value
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Fix
from skillc_dsl.source import Span


def clause(setting: Setting, scope: Scope, written: s.Condition) -> Clause:
    """Return what a condition means; what cannot be understood is reported."""
    match written:
        case s.Relation():
            return _holds(setting, scope, written)
        case s.Compare():
            return _compare(setting, scope, written)
        case s.Has(subject=subject, property=name, span=span):
            of = value(setting, scope, subject)
            iri = property_of(setting, of, name) or name.text
            return Clause(HasProperty(_term(setting, of), iri), span, (of,))
        case s.Is(subject=subject, cls=name, span=span):
            of = value(setting, scope, subject, Wanted(Thing(None)))
            return Clause(IsA(_term(setting, of), _class(setting, name)), span, (of,))
        case s.Given(parameter=name, span=span):
            return _given(setting, scope, name, span)
        case s.Not(body=body, span=span):
            return _not(clause(setting, scope, body), span)
        case s.And(parts=parts, span=span):
            clauses = tuple(clause(setting, scope, part) for part in parts)
            return Clause(And(tuple(c.meaning for c in clauses)), span, parts=clauses)
        case s.Or(parts=parts, span=span):
            return _or([clause(setting, scope, part) for part in parts], span)
        case s.Implies(if_=if_, then=then, span=span):
            premise = clause(setting, scope, if_)
            return _or([_not(premise, premise.span), clause(setting, scope, then)], span)
        case s.Quantified():
            return _quantified(setting, scope, written)
        case s.Bare():
            return _bare(setting, scope, written)
        case _:
            assert_never(written)


def _not(body: Clause, span: Span) -> Clause:
    return Clause(Not(body.meaning), span, parts=(body,))


def _or(parts: Sequence[Clause], span: Span) -> Clause:
    return Clause(Or(tuple(part.meaning for part in parts)), span, parts=tuple(parts))


def _holds(setting: Setting, scope: Scope, written: s.Relation) -> Clause:
    subject = _side(setting, scope, written.subject)
    object_ = _side(setting, scope, written.object)
    iri = _relation(setting, written.relation, subject.type, object_.type)
    meaning = Holds(_term(setting, subject), iri or written.relation.text, _term(setting, object_))
    return Clause(meaning, written.span, (subject, object_))


def _side(setting: Setting, scope: Scope, written: s.Value | s.Anything) -> Valued:
    if isinstance(written, s.Anything):
        return Valued(VariableTerm("_"), UNKNOWN, written.span)
    return value(setting, scope, written, Wanted(Thing(None)))


def _relation(setting: Setting, name: s.Name, subject: Type, object_: Type) -> str | None:
    names, vocabulary = setting.names, setting.vocabulary
    if names.is_term("property", name.text) and not names.is_term("relation", name.text):
        setting.report(
            "unknown-relation",
            name.span,
            f"`{name.text}` is a property with a value, not a relation between individuals",
            f"compare its value: `a.{name.text} == ..`",
        )
        return None
    return names.term(
        "relation",
        name,
        lambda iri: any(
            fits(vocabulary, subject, Thing(signature.domain)) and fits(vocabulary, object_, Thing(signature.range))
            for signature in vocabulary.relations[iri].signatures
        ),
    )


def _term(setting: Setting, of: Valued) -> Term:
    """Return the individual that a value stands for; anything else is reported and taken for `_`."""
    match of.meaning:
        case VariableTerm(name="_"):
            return Anything()
        case VariableTerm() | Individual() as term if isinstance(of.type, Thing) or of.type == UNKNOWN:
            return term
    if of.type != UNKNOWN:
        setting.report(
            "not-an-individual",
            of.span,
            "a relation, `has` or `is` speaks of individuals, and this is a value",
            "write a parameter of an ontology class, or an individual; values are compared with `==`, `<`, ..",
        )
    return Anything()


def _class(setting: Setting, name: s.Name) -> str:
    return setting.names.term("class", name) or name.text


def _compare(setting: Setting, scope: Scope, written: s.Compare) -> Clause:
    left, right = _sides(setting, scope, written)
    individuals = [kind for kind in (left.type, right.type) if isinstance(kind, Thing)]
    if individuals and written.operator in ("==", "!=") and _all_terms(left, right):
        same = Clause(Same(_term(setting, left), _term(setting, right)), written.span, (left, right))
        return same if written.operator == "==" else _not(same, written.span)
    return Clause(Compare(left.meaning, written.operator, right.meaning), written.span, (left, right))


def _all_terms(*sides: Valued) -> bool:
    return all(isinstance(side.meaning, VariableTerm | Individual) for side in sides)


def _sides(setting: Setting, scope: Scope, written: s.Compare) -> tuple[Valued, Valued]:
    """Understand the side with the property first: it tells which values a bare name on the other may be."""
    if isinstance(written.left, s.Reference) and isinstance(written.right, s.Member):
        right = value(setting, scope, written.right)
        return _other_side(setting, scope, written.left, right), right
    left = value(setting, scope, written.left)
    return left, _other_side(setting, scope, written.right, left)


def _other_side(setting: Setting, scope: Scope, written: s.Value, known: Valued) -> Valued:
    """Understand the side that `known` is compared with; beside something unknown, a bare name may be anything."""
    match written:
        case s.Reference(name=s.Name(text=text), span=span) if known.type == UNKNOWN and ":" not in text:
            if text not in scope.variables:
                return Valued(VariableTerm(text), UNKNOWN, span)
        case _:
            pass
    return value(setting, scope, written, _wanted(setting, known))


def _wanted(setting: Setting, other: Valued) -> Wanted:
    match other.meaning:
        case PropertyOf(property=iri) if iri in setting.vocabulary.properties:
            return Wanted(other.type, setting.vocabulary.properties[iri].values)
        case VariableTerm() | Individual():
            return Wanted(Thing(None)) if isinstance(other.type, Thing) else Wanted(other.type)
    return ANYTHING if other.type == UNKNOWN else Wanted(other.type)


def _given(setting: Setting, scope: Scope, name: s.Name, span: Span) -> Clause:
    known = scope.variables.get(name.text)
    if known is None or known.origin != "parameter":
        parameters = [n for n, v in scope.variables.items() if v.origin == "parameter"]
        message = f"{scope.owner} has no parameter `{name.text}`"
        setting.report_unknown("unknown-parameter", name, message, parameters, "declare it with `opt`")
    return Clause(Given(name.text), span)


def _quantified(setting: Setting, scope: Scope, written: s.Quantified) -> Clause:
    iri = setting.names.term("class", written.cls)
    kind = (Thing(None) if iri == THING else Thing(iri)) if iri else UNKNOWN
    inner = setting.bind(scope, written.variable, Variable(kind, "variable", written.variable.span))
    body = clause(setting, inner, written.body)
    quantifier = Exists if written.quantifier == "exists" else Forall
    return Clause(quantifier(written.variable.text, iri or THING, body.meaning), written.span, parts=(body,))


def _bare(setting: Setting, scope: Scope, written: s.Bare) -> Clause:
    """A value is no condition; a truth value is one once it is compared."""
    of = value(setting, scope, written.value)
    span = written.span
    end = Span(span.path, span.end_line, span.end_column, span.end_line, span.end_column)
    if of.type == BOOL:
        fix = Fix(end, " == true", "compare it with `true`")
        setting.names.problems.append(
            Diagnostic("not-a-condition", span, "a value is not a condition", "write `.. == true`", fix=fix)
        )
    elif of.type != UNKNOWN:
        setting.report("not-a-condition", span, "a value is not a condition", "compare it: `.. == ..`, `.. < ..`")
    return Clause(Compare(of.meaning, "==", Literal(True)), span, (of,))
