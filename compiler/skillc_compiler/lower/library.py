"""Lowers a program: what is sound becomes the library, what has errors is left out."""

from __future__ import annotations

import hashlib
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence

import msgspec

from skillc_compiler.logic.ranking import ranked
from skillc_compiler.lower import flattening
from skillc_compiler.program.spans import Places
from skillc_compiler.program.typed import Call, Implementation, Program, ReadFile, TypedNode
from skillc_dsl.diagnostics import Diagnostic
from skillc_model import skills as library
from skillc_model.pddl.names import pddl_names
from skillc_model.skills import SkillLibrary


def lower(program: Program, problems: Sequence[Diagnostic]) -> SkillLibrary:
    """Return the library of everything in which no error was found, and which calls only such skills."""
    errors = Places(problem.span for problem in problems if problem.severity == "error")
    skills = {name: s for name, s in sorted(program.skills.items()) if not errors.any_on_lines_of(s.span)}
    sound = [i for i in program.implementations if i.body is not None and not errors.any_on_lines_of(i.span)]
    kept = [i for i in sound if i.skill.name in skills and _calls_known(i.body, skills)]
    by_skill: dict[str, list[Implementation]] = defaultdict(list)
    for one in kept:
        by_skill[one.skill.name].append(one)
    order = {name: ranked(program.vocabulary, by_skill[name]) for name in skills}
    unnamed = SkillLibrary(
        name=program.name,
        hash=_hash(program.files),
        vocabulary=program.vocabulary,
        skills={name: flattening.skill(s, [i.name for i in order[name]]) for name, s in skills.items()},
        implementations={i.key: _implementation(i) for i in sorted(kept, key=lambda i: i.key)},
        tasks={
            task.name: flattening.task(task)
            for task in sorted(program.tasks, key=lambda task: task.name)
            if not errors.any_on_lines_of(task.span) and _calls_known(task.body, skills)
        },
    )
    return msgspec.structs.replace(unnamed, names=pddl_names(unnamed))


def calls(step: TypedNode) -> Iterator[Call]:
    """Yield every call in a body, in order."""
    if step.call:
        yield step.call
    for child in (*step.children, *step.orelse):
        yield from calls(child)


def _implementation(understood: Implementation) -> library.Implementation:
    assert understood.body is not None
    return flattening.implementation(understood, understood.body)


def _calls_known(body: object, skills: Iterable[str]) -> bool:
    return not isinstance(body, TypedNode) or all(call.skill and call.skill.name in skills for call in calls(body))


def _hash(files: Sequence[ReadFile]) -> str:
    digest = hashlib.sha256()
    for path, text in sorted((unit.file.path, unit.text) for unit in files):
        digest.update(f"{path}\0{text}\0".encode())
    return digest.hexdigest()
