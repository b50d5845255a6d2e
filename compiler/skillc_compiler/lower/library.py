"""Lowers a program: declarations without errors become the library, the others are left out."""

from __future__ import annotations

import hashlib
from collections import defaultdict
from collections.abc import Iterable, Sequence
from functools import partial

import msgspec

from skillc_compiler.logic.selection import rank_implementations
from skillc_compiler.lower import declarations as flattening
from skillc_compiler.program.program import ParsedFile, Program
from skillc_compiler.program.spans import SpanIndex
from skillc_compiler.program.typed import Implementation, Skill, Task, Test, TypedNode
from skillc_compiler.program.walk import calls_in
from skillc_compiler.resolve.declaring.declarations import used_vocabularies
from skillc_compiler.resolve.files import library_namespace
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.editions import NEWEST
from skillc_dsl.query import Memo
from skillc_model import skills as library
from skillc_model.pddl.constants import mentions_of
from skillc_model.pddl.names import assign_names
from skillc_model.skills import SkillLibrary


def lower_program(program: Program, problems: Sequence[Diagnostic], memo: Memo | None = None) -> SkillLibrary:
    """Return the library of all declarations without errors that call only such skills."""
    memo = memo or Memo()
    errors = SpanIndex(problem.span for problem in problems if problem.severity == "error")
    skills = {name: s for name, s in sorted(program.skills.items()) if not errors.any_on_lines_of(s.span)}
    sound = [i for i in program.implementations if i.body is not None and not errors.any_on_lines_of(i.span)]
    kept = [i for i in sound if i.skill.name in skills and _calls_known(i.body, skills)]
    by_skill: dict[str, list[Implementation]] = defaultdict(list)
    for one in kept:
        by_skill[one.skill.name].append(one)
    order = {name: rank_implementations(program.vocabulary, by_skill[name]) for name in skills}
    tasks = [
        task
        for task in sorted(program.tasks, key=lambda task: task.name)
        if not errors.any_on_lines_of(task.span) and _calls_known(task.body, skills)
    ]
    unnamed = SkillLibrary(
        name=program.name,
        namespace=_namespace(program),
        uses=_uses(program),
        hash=_hash(program.files),
        vocabulary=program.vocabulary,
        skills={
            name: memo.ask("lowered skill", (s, *order[name]), partial(_skill, s, order[name]))
            for name, s in skills.items()
        },
        implementations={
            i.key: memo.ask("lowered implementation", (i,), partial(_implementation, i))
            for i in sorted(kept, key=lambda i: i.key)
        },
        tasks={t.name: memo.ask("lowered task", (t,), partial(_task, t)) for t in tasks if not isinstance(t, Test)},
        tests={each.name: flattening.lower_test(each) for each in tasks if isinstance(each, Test)},
    )
    return msgspec.structs.replace(unnamed, names=_assign_names(unnamed, memo))


def _uses(program: Program) -> tuple[str, ...]:
    """Return the namespaces that the files of a library use, and those of the files that they import."""
    prefixes = program.vocabulary.prefixes
    used = {prefix for unit in program.files for prefix in used_vocabularies(unit.file, program.vocabulary)}
    return tuple(
        sorted({*map(prefixes.__getitem__, used & prefixes.keys()), *(unit.namespace for unit in program.files)})
    )


def _assign_names(unnamed: SkillLibrary, memo: Memo) -> dict[str, str]:
    """Return the names for planners: those of the analysis before if the same things need names."""
    vocabulary = unnamed.vocabulary
    named = (
        memo.ask(
            "named individuals",
            (skill, *unnamed.implementations_of(name), vocabulary),
            partial(_individuals_in, unnamed, skill),
        )
        for name, skill in unnamed.skills.items()
    )
    needed = memo.same("named individuals", "", (tuple(unnamed.skills), frozenset[str]().union(*named)))
    return memo.ask("planning names", (needed, vocabulary), partial(assign_names, unnamed))


def _individuals_in(of: SkillLibrary, skill: library.Skill) -> frozenset[str]:
    found = mentions_of(skill, of.implementations_of(skill.name), of.vocabulary) if skill.planned else ()
    return frozenset(each.individual for each in found)


def _namespace(program: Program) -> str:
    """Return the namespace of the terms that the library itself declares."""
    own = (unit.namespace for unit in program.files if unit.library == program.name)
    return next(own, library_namespace(program.name))


def _skill(typed: Skill, order: Sequence[Implementation]) -> library.Skill:
    return flattening.lower_skill(typed, [each.name for each in order])


def _implementation(typed: Implementation) -> library.Implementation:
    assert typed.body is not None
    return flattening.lower_implementation(typed, typed.body)


def _task(typed: Task) -> library.Task:
    return flattening.lower_task(typed)


def _calls_known(body: object, skills: Iterable[str]) -> bool:
    return not isinstance(body, TypedNode) or all(call.skill and call.skill.name in skills for call in calls_in(body))


def _hash(files: Sequence[ParsedFile]) -> str:
    digest = hashlib.sha256()
    for path, text, edition in sorted((unit.file.path, unit.text, unit.edition) for unit in files):
        written_in = f"{edition}\0" if edition < NEWEST else ""
        digest.update(f"{path}\0{text}\0{written_in}".encode())
    return digest.hexdigest()
