"""The parts of a program that are checked on their own: one declaration each."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from dataclasses import replace
from enum import Enum, auto
from functools import partial
from typing import TypeVar

import msgspec
from msgspec import structs

from skillc_compiler.program.called import called_by
from skillc_compiler.program.program import DefinedRelation, ParsedFile, Program
from skillc_compiler.program.typed import Implementation, Skill, Task
from skillc_dsl import syntax as s

Declared = TypeVar("Declared", Skill, Implementation, Task, DefinedRelation)


class Reads(Enum):
    """What a check reads.

    WRITTEN: one declaration as it is written. DECLARATION: one declaration as it is resolved, with the skills that it
    names and the vocabulary. FAMILY: a skill with its implementations, or a task, and the implementations of the skills
    that these call. PYTHON: also files of Python. PROOFS: the proofs of bodies. NEIGHBOURS: also the skills and
    implementations that a declaration names or may run, the rest of its file and what it imports. LIBRARY: everything,
    but of bodies only which skills they call.
    """

    WRITTEN = auto()
    DECLARATION = auto()
    FAMILY = auto()
    PYTHON = auto()
    PROOFS = auto()
    NEIGHBOURS = auto()
    LIBRARY = auto()


class Part(msgspec.Struct, frozen=True):
    """A declaration as written or resolved, and a program of it alone, which depends on `of` only."""

    of: tuple[object, ...]
    program: Callable[[], Program]


def resolved_parts(program: Program) -> Iterator[Part]:
    """Yield every declaration of a program as it is resolved."""
    resolved: list[Skill | Implementation | Task | DefinedRelation] = [
        *program.defined,
        *program.skills.values(),
        *program.implementations,
        *program.tasks,
    ]
    for each in resolved:
        yield Part((each, program.vocabulary), partial(_alone, program, each))


def written_parts(program: Program) -> Iterator[Part]:
    """Yield every declaration of a program as it is written."""
    for unit in program.files:
        for declaration in unit.file.declarations:
            yield Part((declaration,), partial(_written_alone, program, unit, declaration))


def families_of(program: Program, paths: Collection[str] | None = None) -> Iterator[Part]:
    """Yield every skill with its implementations, and every task; with `paths`, only those with a part in these files.

    Each has as `neighbours` the implementations of the skills that its bodies call.
    """
    for skill in program.skills.values():
        own = program.implementations_of[skill.name]
        if paths is None or skill.span.path in paths or any(each.span.path in paths for each in own):
            yield _family(program, skill, own)
    for task in program.tasks:
        if paths is None or task.span.path in paths:
            yield _family(program, task, (task,))


def _family(program: Program, head: Skill | Task, bodies: Sequence[Implementation | Task]) -> Part:
    called = {each.key: each for body in bodies for each in called_by(program, body)}
    neighbours = tuple(each for each in called.values() if not any(each is body for body in bodies))
    implementations = tuple(each for each in bodies if isinstance(each, Implementation))

    def family() -> Program:
        return replace(_alone(program, head), implementations=implementations, neighbours=neighbours)

    return Part((head, *implementations, *neighbours, program.vocabulary), family)


def split_by_file(program: Program) -> dict[str, Program]:
    """Return, by path, a program with the declarations of one file only."""
    files = {unit.file.path: unit for unit in program.files}
    skills, implementations = _by_path(program.skills.values()), _by_path(program.implementations)
    tasks, defined = _by_path(program.tasks), _by_path(program.defined)
    return {
        path: replace(
            program,
            files=(files[path],) if path in files else (),
            skills={each.name: each for each in skills[path]},
            implementations=tuple(implementations[path]),
            tasks=tuple(tasks[path]),
            defined=tuple(defined[path]),
        )
        for path in dict.fromkeys((*files, *skills, *implementations, *tasks, *defined))
    }


def _by_path(declared: Iterable[Declared]) -> defaultdict[str, list[Declared]]:
    found = defaultdict[str, list[Declared]](list)
    for each in declared:
        found[each.span.path].append(each)
    return found


def _alone(program: Program, each: Skill | Implementation | Task | DefinedRelation) -> Program:
    return Program(
        name=program.name,
        vocabulary=program.vocabulary,
        files=(),
        skills={each.name: each} if isinstance(each, Skill) else {},
        implementations=(each,) if isinstance(each, Implementation) else (),
        tasks=(each,) if isinstance(each, Task) else (),
        used={},
        defined=(each,) if isinstance(each, DefinedRelation) else (),
    )


def _written_alone(program: Program, unit: ParsedFile, declaration: s.Declaration) -> Program:
    file = structs.replace(unit.file, declarations=(declaration,))
    return Program(program.name, program.vocabulary, (structs.replace(unit, file=file),), {}, (), (), {})
