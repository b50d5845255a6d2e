"""Converts goals in PDDL to the syntax tree of a `.skill` goal."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from typing import Literal, TypeAlias

import msgspec

from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Span

COMPARING = frozenset(("<", "<=", ">", ">=", "="))
_TOKEN = re.compile(r"[()]|[^\s()]+")


class PddlWord(msgspec.Struct, frozen=True):
    """A name, variable, keyword or `-`."""

    text: str
    span: Span


class PddlGroup(msgspec.Struct, frozen=True):
    """`( .. )`"""

    parts: tuple[Expression, ...]
    span: Span


Expression: TypeAlias = PddlWord | PddlGroup


class PddlGoalError(Exception):
    """The text is not a PDDL goal; `problem` is the diagnostic."""

    def __init__(self, problem: Diagnostic) -> None:
        super().__init__(problem.message)
        self.problem = problem


def parse_group(text: str, path: str) -> PddlGroup | None:
    """Return a text as nested groups, or None if it is not exactly one balanced group."""
    open_groups: list[list[Expression]] = [[]]
    starts: list[Span] = []
    for word in _words(text, path):
        match word.text:
            case "(":
                open_groups.append([])
                starts.append(word.span)
            case ")" if not starts:
                return None
            case ")":
                group = PddlGroup(tuple(open_groups.pop()), starts.pop().to(word.span))
                open_groups[-1].append(group)
            case _:
                open_groups[-1].append(word)
    match open_groups:
        case [[PddlGroup() as whole]]:
            return whole
    return None


def convert_goal(group: PddlGroup, is_class: Callable[[str], bool]) -> s.Condition:
    """Return the condition that is equivalent to a PDDL goal. Raises PddlGoalError if the group is not a goal."""
    match group.parts:
        case [PddlWord(text="and"), *parts]:
            return s.And(tuple(convert_goal(_group(part), is_class) for part in parts), group.span)
        case [PddlWord(text="or"), *parts]:
            return s.Or(tuple(convert_goal(_group(part), is_class) for part in parts), group.span)
        case [PddlWord(text="not"), body]:
            return s.Not(convert_goal(_group(body), is_class), group.span)
        case [PddlWord(text="imply"), premise, then]:
            return s.Implies(convert_goal(_group(premise), is_class), convert_goal(_group(then), is_class), group.span)
        case [PddlWord(text="exists"), PddlGroup() as variables, body]:
            return _quantified("exists", variables, convert_goal(_group(body), is_class), group)
        case [PddlWord(text="forall"), PddlGroup() as variables, body]:
            return _quantified("forall", variables, convert_goal(_group(body), is_class), group)
        case [PddlWord(text="="), PddlWord() as left, PddlWord() as right]:
            return s.Compare(_reference(left), "==", _reference(right), group.span)
        case [PddlWord(text=operator), left, right] if operator in COMPARING:
            raise _comparison(operator, left, right, group.span)
        case [PddlWord() as relation, PddlWord() as subject, PddlWord() as object_]:
            return s.Relation(_reference(subject), _name(relation), _reference(object_), group.span)
        case [PddlWord() as name, PddlWord() as subject] if is_class(name.text):
            return s.Is(_reference(subject), _name(name), group.span)
        case [PddlWord() as name, PddlWord() as subject]:
            value = s.Member(_reference(subject), _name(name), group.span)
            return s.Compare(value, "==", s.Boolean(True, group.span), group.span)
    raise _refusal(group.span, "this is not a goal")


def _quantified(
    kind: Literal["exists", "forall"], variables: PddlGroup, body: s.Condition, whole: PddlGroup
) -> s.Condition:
    for variable, cls in reversed(list(_typed(variables.parts, whole))):
        body = s.Quantified(kind, variable, cls, body, whole.span)
    return body


def _group(part: Expression) -> PddlGroup:
    if isinstance(part, PddlGroup):
        return part
    raise _refusal(part.span, f"`{part.text}` stands alone where a goal in parentheses belongs")


def _typed(parts: Sequence[Expression], of: PddlGroup) -> Iterator[tuple[s.Name, s.Name]]:
    """Yield the variables of `(?x ?y - Class ..)` with their classes; the default is `Thing`."""
    waiting: list[PddlWord] = []
    remaining = iter(parts)
    for part in remaining:
        if not isinstance(part, PddlWord):
            raise _refusal(part.span, "variables are written `?x - Class`")
        if part.text != "-":
            waiting.append(part)
            continue
        cls = next(remaining, None)
        if not isinstance(cls, PddlWord):
            raise _refusal(of.span, "a class is missing after `-`")
        yield from ((_name(variable), _name(cls)) for variable in waiting)
        waiting = []
    yield from ((_name(variable), s.Name("Thing", variable.span)) for variable in waiting)


def _reference(word: PddlWord) -> s.NameReference:
    return s.NameReference(_name(word), word.span)


def _name(word: PddlWord) -> s.Name:
    return s.Name(word.text.removeprefix("?"), word.span)


def _refusal(span: Span, message: str) -> PddlGoalError:
    help_ = "a goal is `(relation subject object)` or `(property individual)`, joined by and, or, not, exists, forall"
    return PddlGoalError(Diagnostic("syntax", span, message, help_))


def _comparison(operator: str, left: Expression, right: Expression, span: Span) -> PddlGoalError:
    """Return the error for a comparison of values, which PDDL cannot express since it has no units."""
    own = f"{_said(left)} {'==' if operator == '=' else operator} {_said(right)}"
    help_ = f"write it as in a .skill file, numbers with their units: `{own}`, and all around it in that way too"
    return PddlGoalError(Diagnostic("syntax", span, "a PDDL goal compares no values of properties", help_))


def _said(expression: Expression) -> str:
    """Return a value in the syntax of the language: `(p x)` becomes `x.p`."""
    match expression:
        case PddlWord(text=text):
            return text.removeprefix("?")
        case PddlGroup(parts=[PddlWord(text=name), PddlWord(text=owner)]):
            return f"{owner.removeprefix('?')}.{name}"
        case PddlGroup():
            return ".."


def _words(text: str, path: str) -> Iterator[PddlWord]:
    for number, line in enumerate(text.split("\n"), start=1):
        for found in _TOKEN.finditer(line.partition(";")[0]):
            yield PddlWord(found.group(), Span(path, number, found.start() + 1, number, found.end() + 1))
