"""Leaves out what only follows from a misspelt file, vocabulary, skill or term, or from a duplicate skill."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Sequence, Set
from typing import TypeAlias

from skillc_compiler.diagnostics.renamed import told_once
from skillc_compiler.program.spans import DisjointSpans, SpanIndex
from skillc_compiler.program.typed import ParsedFile
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Span

Explains: TypeAlias = Callable[[Diagnostic], bool]

HEADER = frozenset({"unknown-import", "unknown-vocabulary", "import-cycle"})
UNUSED_IN_HEADER = frozenset({"unused-use", "unused-prefix", "unused-import"})
UNUSED = UNUSED_IN_HEADER | {"unused-let", "unused-parameter"}
TERMS = frozenset({"unknown-class", "unknown-type", "unknown-relation", "unknown-property"})
NAMES = TERMS | {"unknown-function", "unknown-skill", "unknown-prefix"}
PASSED = frozenset({"unknown-argument", "unknown-skill", "unknown-function"})
TYPES = frozenset({"relation-domain", "relation-range", "property-domain", "wrong-type", "disjoint-types"})
LOGIC = frozenset({"contradicting-conditions", "always-true", "always-false", "duplicate-condition", "breaks-axiom"})
REASONED = frozenset(
    {
        "ambiguous-selection",
        "child-precondition",
        "hold-broken",
        "never-selected",
        "no-fitting-implementation",
        "not-decided",
        "not-released",
        "parallel-conflict",
        "post-not-established",
        "undeclared-effect",
        "unreachable-node",
    }
)
WHOLE = frozenset({"unachievable-goal", "no-implementation", "unreachable-skill"})


def without_consequences(
    found: Iterable[Diagnostic], problems: Sequence[Diagnostic], files: Sequence[ParsedFile]
) -> Iterator[Diagnostic]:
    """Yield the diagnostics that no other one explains; a misspelt declaration is reported once."""
    explanations = (
        *_of_headers(problems),
        *_of_second_skills(problems, files),
        *_of_terms(problems, files),
        *_of_implemented(problems, files),
        *_of_conditions(problems),
        *_of_bodies(problems, files),
        *_of_arguments(problems, files),
    )
    left = [problem for problem in found if not any(explains(problem) for explains in explanations)]
    return told_once(left, files)


def _of_headers(problems: Iterable[Diagnostic]) -> Iterator[Explains]:
    """A missing file or vocabulary explains unknown names in its file, and types that depend on them.

    If it was clear which one is meant, its names are known. A name so close to a known one that a fix is offered is a
    mistake of its own.
    """
    wrong = [problem for problem in problems if problem.name in HEADER]
    unread = {problem.span.path for problem in wrong if problem.fix is None}
    yield lambda d: d.span.path in unread and (d.name in TYPES or (d.name in NAMES and d.fix is None))
    yield lambda d: bool(unread) and d.name in WHOLE


def _of_second_skills(problems: Iterable[Diagnostic], files: Sequence[ParsedFile]) -> Iterator[Explains]:
    """A duplicate skill explains the problems of calls and implementations written for the other one."""
    second = [problem for problem in problems if problem.name == "duplicate-declaration"]
    first = {label.span for problem in second for label in problem.labels}
    spans = [d.span for unit in files for d in unit.file.declarations if _is_skill(d) and d.name.span in first]
    skills = DisjointSpans(spans)
    yield lambda d: bool(spans) and d.name in WHOLE
    yield (
        lambda d: (
            d.name != "duplicate-declaration"
            and any(skills.enclosing(label.span) not in (None, skills.enclosing(d.span)) for label in d.labels)
        )
    )
    yield lambda d: bool(second) and d.name in UNUSED


def _of_terms(problems: Sequence[Diagnostic], files: Sequence[ParsedFile]) -> Iterator[Explains]:
    """An unknown term explains an unachievable goal that contains it; one in a post explains every unachievable goal.

    Anything unknown explains unused lines in the header of its file; an unknown skill also explains unreachable skills.
    """
    misspelt = {problem.span.path for problem in problems if problem.name in NAMES | HEADER}
    yield lambda d: d.name in UNUSED_IN_HEADER and d.span.path in misspelt
    called = any(problem.name == "unknown-skill" for problem in problems)
    yield lambda d: called and d.name == "unreachable-skill"
    wrong = [problem.span for problem in problems if problem.name in TERMS]
    posts = DisjointSpans(
        member.span
        for unit in files
        for declaration in unit.file.declarations
        if isinstance(declaration, s.SkillDeclaration)
        for member in declaration.members
        if isinstance(member, s.Requirement) and member.kind == "post"
    )
    in_posts = any(posts.enclosing(place) for place in wrong)
    places = SpanIndex(wrong)
    yield lambda d: d.name == "unachievable-goal" and (in_posts or places.any_inside(d.span))


def _of_implemented(problems: Iterable[Diagnostic], files: Sequence[ParsedFile]) -> Iterator[Explains]:
    """An implementation of an unknown skill explains that a skill with a similar name has none."""
    of = {
        declaration.skill.span
        for unit in files
        for declaration in unit.file.declarations
        if isinstance(declaration, s.ImplementationDeclaration)
    }
    helps = "\n".join(problem.help for problem in problems if problem.name == "unknown-skill" and problem.span in of)
    names = {d.name.span: f"`{d.name.text}`" for unit in files for d in unit.file.declarations if _is_skill(d)}
    yield lambda d: d.name == "no-implementation" and names[d.span] in helps


def _of_conditions(problems: Iterable[Diagnostic]) -> Iterator[Explains]:
    """An error in a condition explains that it is always true or false, or contradicts another."""
    wrong = _errors(problems, LOGIC | REASONED)
    yield lambda d: d.name in LOGIC and any(wrong.any_inside(whole) for whole in _spans(d))


def _of_bodies(problems: Iterable[Diagnostic], files: Sequence[ParsedFile]) -> Iterator[Explains]:
    """Declarations with another error, and what implements or calls such a skill, are not reasoned about."""
    wrong = _errors(problems, REASONED)
    declarations = [d for unit in files for d in unit.file.declarations]
    broken = [d for d in declarations if wrong.any_inside(d.span)]
    skills = {d.name.text for d in broken if isinstance(d, s.SkillDeclaration)}
    followers = _that_depend(skills, [d for d in declarations if isinstance(d, s.ImplementationDeclaration)])
    wholes = DisjointSpans(d.span for d in (*broken, *followers))
    yield lambda d: d.name in REASONED and any(wholes.enclosing(place) for place in _spans(d))


def _that_depend(
    skills: Set[str], implementations: Iterable[s.ImplementationDeclaration]
) -> Iterator[s.ImplementationDeclaration]:
    """Yield the implementations of these skills, and those whose bodies call one of them or the skill of another."""
    if not skills:
        return
    of, callers = defaultdict(list), defaultdict(list)
    for implementation in implementations:
        of[implementation.skill.text].append(implementation)
        for called in _called(implementation):
            callers[called].append(implementation)
    yield from (each for skill in skills for each in of[skill])
    todo, seen = [*skills], {*skills}
    while todo:
        for each in callers[todo.pop()]:
            yield each
            if each.skill.text not in seen:
                seen.add(each.skill.text)
                todo.append(each.skill.text)


def _called(declaration: s.ImplementationDeclaration) -> Iterator[str]:
    """Yield the names of the skills that a body calls."""
    todo: list[s.Node] = [member.node for member in declaration.members if isinstance(member, s.Body)]
    while todo:
        match todo.pop():
            case s.CallSkill(skill=skill):
                yield skill.text
            case s.With(call=call, children=children):
                todo += [call, *children]
            case s.If(then=then, orelse=orelse):
                todo += [*then, *(orelse or ())]
            case s.Block() | s.Counted() | s.Timeout() | s.While() | s.For() as node:
                todo += node.children
            case s.Wait() | s.WaitUntil() | s.CheckNode() | s.ApplyPosts():
                pass


def _of_arguments(problems: Iterable[Diagnostic], files: Sequence[ParsedFile]) -> Iterator[Explains]:
    """A value passed as an unknown argument, or to an unknown skill or function, is used."""
    wrong = SpanIndex(problem.span for problem in problems if problem.name in PASSED)
    done = [d for unit in files for d in unit.file.declarations if isinstance(d, s.ImplementationDeclaration)]
    broken = [d for d in done if wrong.any_inside(d.span)]
    skills = {d.skill.text for d in broken}
    described = [d for unit in files for d in unit.file.declarations if _is_skill(d) and d.name.text in skills]
    wholes = DisjointSpans(d.span for d in (*broken, *described))
    yield lambda d: d.name in UNUSED and wholes.enclosing(d.span) is not None


def _errors(problems: Iterable[Diagnostic], other_than: Set[str]) -> SpanIndex:
    found = (problem for problem in problems if problem.severity == "error" and problem.name not in other_than)
    return SpanIndex(problem.span for problem in found)


def _spans(problem: Diagnostic) -> tuple[Span, ...]:
    return problem.span, *(label.span for label in problem.labels)


def _is_skill(declaration: s.Declaration) -> bool:
    return isinstance(declaration, s.SkillDeclaration)
