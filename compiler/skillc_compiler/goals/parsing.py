"""Parses goals and calls given at run time, in `.skill`, PDDL or JSON syntax, with the same checks as for files."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Literal, TypeAlias, TypeVar

import msgspec

from skillc_compiler.checks import run_checks
from skillc_compiler.diagnostics.unknown_names import render_unknown_name
from skillc_compiler.goals.context import make_context
from skillc_compiler.goals.json_text import JsonGoalError, is_json, write_goal
from skillc_compiler.goals.mistakes import EXAMPLES, InputKind, find_mistakes, reword
from skillc_compiler.goals.pddl_text import COMPARING, PddlGoalError, PddlGroup, PddlWord, convert_goal, parse_group
from skillc_compiler.goals.skill_as_goal import report_skill_as_goal
from skillc_compiler.lower.bodies import lower_node
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Task
from skillc_compiler.resolve.individuals import Individuals
from skillc_compiler.resolve.names import KINDS, Names
from skillc_compiler.resolve.scope import FileContext
from skillc_compiler.resolve.tasks import resolve_task
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Outcome
from skillc_dsl.editions import EDITIONS
from skillc_dsl.parsing.parser import parse
from skillc_dsl.position import Position
from skillc_dsl.source import Source, Span
from skillc_model import tree
from skillc_model.conditions import Condition
from skillc_model.rewriting import fold
from skillc_model.skills import Skill, SkillLibrary
from skillc_model.traversal import is_nested_deeper
from skillc_rdf.vocabulary.types import Vocabulary

T = TypeVar("T")
ConditionKind: TypeAlias = Literal["goal", "condition"]

LONGEST, DEEPEST = 50_000, 100
"""The maximum length of a goal or call in characters, and its maximum depth of nesting."""
LINES_ABOVE = 2
BETWEEN = frozenset(("==", "!=", "<", "<=", ">", ">=", "is", "has"))
"""Infix keywords in conditions."""


def parse_goal(
    text: str,
    vocabulary: Vocabulary,
    individuals: Individuals,
    prefixes: Mapping[str, str] | None = None,
    home: Sequence[str] = (),
    skills: Mapping[str, Skill] | None = None,
    what: ConditionKind = "goal",
) -> Outcome[Condition | None]:
    """Parse a goal such as `lab:Board.isClean == true` or `(skiros:contain lab:Box-1 lab:Part-1)`.

    `individuals` are the IRIs of the scene with their classes, `prefixes` those that its file declares, and `home` the
    namespaces that bare names refer to first (see `home_of`). If the text names one of the `skills` instead of a
    condition, the error says which condition to write. The value is None if there are errors; spans are positions in
    `text`, with the path `goal`. A goal may also be a condition in JSON, as a compiled library has it. Any other
    condition is read in the same way; `what` is how messages call it, and the path.
    """
    if is_json(text):
        return _goal_in_json(text, vocabulary, individuals, prefixes or {}, what)
    return _bounded(
        lambda: _goal(text, make_context(vocabulary, individuals, prefixes or {}, None, home), skills or {}, what),
        text,
        what,
    )


def home_of(library: SkillLibrary) -> tuple[str, ...]:
    """Return the namespaces whose terms a library writes by bare names: its own, and those that it uses."""
    return (library.namespace, *library.uses)


def parse_call(
    text: str, library: SkillLibrary, individuals: Individuals, prefixes: Mapping[str, str] | None = None
) -> Outcome[tree.Call | None]:
    """Parse a call such as `Wipe(surface: lab:Board)`, like `parse_goal`, with the path `call`."""
    asked = make_context(library.vocabulary, individuals, prefixes or {}, library.skills, home_of(library))
    return _bounded(lambda: _call(text, asked), text, "call")


def _goal_in_json(
    text: str, vocabulary: Vocabulary, individuals: Individuals, prefixes: Mapping[str, str], what: ConditionKind
) -> Outcome[Condition | None]:
    """Parse a goal in JSON. What is wrong with its names and types has no place in the text."""
    if len(text) > LONGEST:
        return _refused(what, f"the {what} has {len(text)} characters, and {LONGEST} at most are read")
    try:
        written = write_goal(text, vocabulary, prefixes)
    except JsonGoalError as error:
        return _refused(what, f"this is no condition in JSON: {error}")
    except RecursionError:
        return _refused(what, f"the {what} is nested too deeply")
    outcome = parse_goal(written, vocabulary, individuals, prefixes, what=what)
    start = Span(what, 1, 1, 1, 2)
    return Outcome(outcome.value, tuple(replace(each, span=start, labels=(), fix=None) for each in outcome.diagnostics))


def _bounded(understand: Callable[[], Outcome[T]], text: str, what: InputKind) -> Outcome[T | None]:
    """Parse a text, unless it exceeds the maximum length or depth of nesting."""
    if len(text) > LONGEST:
        return _refused(what, f"the {what} has {len(text)} characters, and {LONGEST} at most are read")
    try:
        outcome = understand()
    except RecursionError:
        return _refused(what, f"the {what} is nested too deeply")
    if isinstance(outcome.value, msgspec.Struct) and is_nested_deeper(outcome.value, DEEPEST):
        return _refused(what, f"the {what} is nested more than {DEEPEST} deep")
    return outcome


def _refused(what: InputKind, message: str) -> Outcome[None]:
    return Outcome(None, (Diagnostic("syntax", Span(what, 1, 1, 1, 2), message, EXAMPLES[what]),))


def _goal(text: str, asked: FileContext, skills: Mapping[str, Skill], what: ConditionKind) -> Outcome[Condition | None]:
    own = {name: skill for name, skill in skills.items() if not _is_term(asked.names, name)}
    skill = report_skill_as_goal(text, own, asked.vocabulary)
    wrong = (skill,) if skill is not None else _mistakes(asked, text, what)
    if wrong:
        return Outcome(None, wrong)
    group = parse_group(text, what)
    if group is not None and _is_pddl(group, asked.names):
        resolved = _resolve(asked, _from_pddl(group, text, asked.names))
    else:
        resolved = _in_text(_resolve(asked, _wrapped(text, what)), text, what)
    reached = resolved.value.goal if resolved.value else None
    return Outcome(fold(reached.meaning) if reached else None, resolved.diagnostics)


def _call(text: str, asked: FileContext) -> Outcome[tree.Call | None]:
    wrong = _mistakes(asked, text, "call")
    if wrong:
        return Outcome(None, wrong)
    resolved = _in_text(_resolve(asked, _wrapped(text, "call")), text, "call")
    called = lower_node(resolved.value.body) if resolved.value and resolved.value.body else None
    if not isinstance(called, tree.Call):
        return Outcome(None, resolved.diagnostics)
    return Outcome(msgspec.structs.replace(called, source=Position("call", 1, 1)), resolved.diagnostics)


def _mistakes(asked: FileContext, text: str, what: InputKind) -> tuple[Diagnostic, ...]:
    names = asked.names
    written = (names.shorten(iri) for iri in asked.individuals or ())
    return find_mistakes(text, what, written, lambda word: _is_term(names, word))


def _is_term(names: Names, word: str) -> bool:
    return any(names.is_term(kind, word) for kind in KINDS)


def _is_pddl(group: PddlGroup, names: Names) -> bool:
    """Whether a text in parentheses is PDDL: `(a r b)` is not if `r` is a relation and `a` is not."""
    match group.parts:
        case [PddlWord(text="not"), PddlGroup() as inner]:
            return _is_pddl(inner, names)
        case [PddlWord(text="exists" | "forall"), PddlWord(text=first), *_]:
            return not first.endswith(":")
        case [PddlWord(text="and" | "or" | "imply" | "exists" | "forall" | "="), *_]:
            return True
        case [PddlWord(text=operator), PddlGroup(), _] | [PddlWord(text=operator), _, PddlGroup()] if (
            operator in COMPARING
        ):
            return True
        case [PddlWord(text=first), PddlWord(text=second), PddlWord()]:
            return names.is_term("relation", first) or not (second in BETWEEN or names.is_term("relation", second))
        case [PddlWord(), PddlWord()]:
            return True
    return False


def _from_pddl(group: PddlGroup, text: str, names: Names) -> Outcome[s.TaskDeclaration | None]:
    try:
        condition = convert_goal(group, lambda name: names.is_term("class", name))
    except PddlGoalError as refusal:
        return Outcome(None, (refusal.problem,))
    return Outcome(
        s.TaskDeclaration(
            s.Name("goal", group.span), (), None, condition, text, None, None, None, None, (), "", group.span
        )
    )


def _wrapped(text: str, what: InputKind) -> Outcome[s.TaskDeclaration | None]:
    """Parse a goal or call as the only member of a task, which begins LINES_ABOVE lines above it.

    It may be right in any edition: a goal does not say of which library it is.
    """
    member = "do" if what == "call" else "goal"
    source = Source(what, f"task {what} {{\n{member}\n{text}\n}}\n")
    read = (parse(source._replace(edition=edition)) for edition in reversed(EDITIONS))
    parsed = next((each for each in read if not each.diagnostics), None) or parse(source)
    if parsed.diagnostics:
        reworded = ((problem, *reword(problem, what)) for problem in parsed.diagnostics)
        return Outcome(
            None, tuple(replace(problem, message=message, help=help_) for problem, message, help_ in reworded)
        )
    match parsed.value:
        case s.File(
            header=(),
            declarations=[s.TaskDeclaration(scene=None, backend=None, within=None, minimise=None, always=()) as alone],
        ):
            is_goal = alone.goal is not None and alone.body is None
            is_call = alone.goal is None and alone.body is not None and isinstance(alone.body.node, s.CallSkill)
            if is_call if what == "call" else is_goal:
                return Outcome(alone)
    span = Span(what, 1 + LINES_ABOVE, 1, 1 + LINES_ABOVE, 2)
    return Outcome(None, (Diagnostic("syntax", span, f"this is not one {what}", EXAMPLES[what]),))


def _resolve(asked: FileContext, written: Outcome[s.TaskDeclaration | None]) -> Outcome[Task | None]:
    """Resolve and check a goal or call; the value is None if there are errors."""
    if written.value is None:
        return Outcome(None, written.diagnostics)
    resolved = resolve_task(asked, written.value)
    program = Program("", asked.vocabulary, (), {}, (), (resolved,), {})
    known = (*asked.names.problems, *(render_unknown_name(each) for each in asked.names.unknown))
    outcome: Outcome[Task | None] = Outcome(resolved, (*known, *run_checks(program, known)))
    return outcome if outcome.ok else Outcome(None, outcome.diagnostics)


def _in_text(outcome: Outcome[Task | None], text: str, path: str) -> Outcome[Task | None]:
    """Move the places of diagnostics from the wrapping task to the text itself."""
    last = max(1, len(text.splitlines()))

    def place(span: Span) -> Span:
        if span.path != path:
            return span
        lines = (min(max(line - LINES_ABOVE, 1), last) for line in (span.line, span.end_line))
        return Span(path, next(lines), span.column, next(lines), span.end_column)

    def move(found: Diagnostic) -> Diagnostic:
        labels = tuple(label._replace(span=place(label.span)) for label in found.labels)
        fix = None if found.fix is None else found.fix._replace(span=place(found.fix.span))
        return replace(found, span=place(found.span), labels=labels, fix=fix)

    return Outcome(outcome.value, tuple(map(move, outcome.diagnostics)))
