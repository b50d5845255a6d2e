"""The parts of a program that are checked on their own: one declaration each."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from enum import Enum, auto

from skillc_compiler.program.typed import Implementation, ParsedFile, Program, Skill, Task
from skillc_dsl import syntax as s


class Reads(Enum):
    """What a check reads.

    DECLARATION: one declaration, the skills that it names and the vocabulary. PROOFS: the proofs of bodies. PROGRAM:
    anything, also files of Python.
    """

    DECLARATION = auto()
    PROOFS = auto()
    PROGRAM = auto()


@dataclass(frozen=True, slots=True)
class Part:
    """A declaration, as written or resolved; `program` makes a program of it alone. It depends on `of` only."""

    of: tuple[object, ...]
    program: Callable[[], Program]


def parts_of(program: Program) -> Iterator[Part]:
    """Yield every declaration of a program: resolved, and as it is written."""
    resolved = (*program.skills.values(), *program.implementations, *program.tasks)
    for each in resolved:
        yield Part((each, program.vocabulary), lambda each=each: _alone(program, each))  # type: ignore[misc]
    for unit in program.files:
        for declaration in unit.file.declarations:
            yield Part(
                (declaration, program.vocabulary),
                lambda unit=unit, declaration=declaration: _written_alone(program, unit, declaration),  # type: ignore[misc]
            )


def _alone(program: Program, each: Skill | Implementation | Task) -> Program:
    return Program(
        name=program.name,
        vocabulary=program.vocabulary,
        files=(),
        skills={each.name: each} if isinstance(each, Skill) else {},
        implementations=(each,) if isinstance(each, Implementation) else (),
        tasks=(each,) if isinstance(each, Task) else (),
        used={},
    )


def _written_alone(program: Program, unit: ParsedFile, declaration: s.Declaration) -> Program:
    file = replace(unit.file, declarations=(declaration,))
    return Program(program.name, program.vocabulary, (replace(unit, file=file),), {}, (), (), {})
