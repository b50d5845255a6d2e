"""Conditions as other languages write them: `hasA(arm, tool)`, `Tool(x)`, a skill as a condition, `a equals b`."""

from __future__ import annotations

from skillc_compiler.resolve.names import Names
from skillc_compiler.resolve.scope import FileContext, Scope
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Fix

NOTHING = frozenset(("null", "None", "nil", "undefined", "nothing"))
"""What other languages call a missing value."""
MISSING = "a missing value is written `not a has property`, a missing individual `not a REL _`"


def report_called_condition(context: FileContext, written: s.Value) -> bool:
    """Report a call of a relation, property, class or skill where a condition is expected; whether it is one."""
    names = context.names
    if not isinstance(written, s.Invoke | s.Aggregate) or written.function.text in names.functions:
        return False
    name = written.function.text
    kind, meant = _term(names, written) if isinstance(written, s.Invoke) else ("", "")
    if not kind and name in names.skills:
        help_ = f"write `do {name}(..)` to run it, or the condition that it makes true"
        problem = Diagnostic("unknown-function", written.span, f"the skill `{name}` is not a condition", help_)
    elif kind:
        message = f"the {kind} `{name}` is not written as a call"
        fix = Fix(written.span, meant, f"write `{meant}`", safe=False)
        problem = Diagnostic("unknown-function", written.span, message, f"write `{meant}`", fix=fix)
    else:
        return False
    names.problems.append(problem)
    return True


def report_relation_first(context: FileContext, scope: Scope, relation: s.Name, written: s.Relation) -> None:
    """Report a relation that stands where its subject should be: `contain box part` as in PDDL, or `tightIn one`."""
    message = f"`{relation.text}` is a relation, and nothing is before it that it relates"
    second = written.relation.text
    if second not in scope.variables and ":" not in second:
        context.report(
            "unknown-parameter", relation.span, message, f"write `a {relation.text} b`, or `_ {relation.text} b`"
        )
        return
    object_ = "_" if isinstance(written.object, s.Anything) else _show(written.object)
    meant = f"{second} {relation.text} {object_}"
    fix = Fix(written.span, meant, f"write `{meant}`", safe=False)
    problem = Diagnostic("unknown-parameter", relation.span, message, f"write `{meant}`", fix=fix)
    context.names.problems.append(problem)


def report_equals(context: FileContext, relation: s.Name) -> bool:
    """Report `a equals b`, which is read as a relation that is not declared; whether it is so."""
    if relation.text != "equals" or context.names.is_term("relation", relation.text):
        return False
    fix = Fix(relation.span, "==", "write `==`", safe=False)
    message = "there is no relation `equals`: values are compared with `==`"
    context.names.problems.append(Diagnostic("unknown-relation", relation.span, message, "write `==`", fix=fix))
    return True


def report_compared_by_is(context: FileContext, subject: s.Value, cls: s.Name) -> bool:
    """Report what is no class after `is`, as in `arm.deviceState is Idle` or `box is empty`; whether it is so."""
    if context.names.is_term("class", cls.text):
        return False
    if cls.text in NOTHING or cls.text == "empty":
        message = f"`is` asks for the class of an individual, and `{cls.text}` is none"
        context.report("unknown-class", cls.span, message, MISSING)
        return True
    if not isinstance(subject, s.Member):
        return False
    fix = Fix(subject.span.after.to(cls.span), f" == {cls.text}", f"write `== {cls.text}`", safe=False)
    message = "`is` asks for the class of an individual, not for the value of a property"
    help_ = f"write `.. == {cls.text}`, or `not a has {subject.property.text}` if it has no value"
    context.names.problems.append(Diagnostic("unknown-class", cls.span, message, help_, fix=fix))
    return True


def _term(names: Names, written: s.Invoke) -> tuple[str, str]:
    """Return the kind of term that is called, and the condition that is meant; two empty strings if it is none."""
    name = written.function.text
    match [_show(each) for each in written.arguments]:
        case [subject, object_] if names.is_term("relation", name):
            return "relation", f"{subject} {name} {object_}"
        case [subject] if names.is_term("property", name):
            return "property", f"{subject}.{name} == true"
        case [subject] if names.is_term("class", name):
            return "class", f"{subject} is {name}"
        case _:
            return "", ""


def _show(value: s.Value) -> str:
    """Return an argument as it is written, if it is a name."""
    return value.name.text if isinstance(value, s.NameReference) else ".."
