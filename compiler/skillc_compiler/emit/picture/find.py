"""Finds what is to be drawn in the files of a library."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from skillc_compiler.emit.picture.boxes import Box
from skillc_compiler.emit.picture.drawing import skill_box, task_box
from skillc_compiler.program.typed import ParsedFile
from skillc_dsl import syntax as s
from skillc_dsl.source import Source


def drawable(files: Sequence[ParsedFile]) -> tuple[str, ...]:
    """Return the names of all skills and tasks, in order."""
    kinds = s.SkillDeclaration | s.TaskDeclaration
    return tuple(sorted({each.name.text for each, _ in _declared(files) if isinstance(each, kinds)}))


def picture_of(name: str, files: Sequence[ParsedFile]) -> Box | None:
    """Return the picture of the skill or the task of that name, None where there is neither."""
    for declared, source in _declared(files):
        match declared:
            case s.SkillDeclaration() if declared.name.text == name:
                return skill_box(declared, source, _implementations(name, files))
            case s.TaskDeclaration() if declared.name.text == name:
                return task_box(declared, source)
            case _:
                pass
    return None


def _declared(files: Sequence[ParsedFile]) -> Iterator[tuple[s.Declaration, Source]]:
    for unit in files:
        source = Source(unit.file.path, unit.text)
        yield from ((declared, source) for declared in unit.file.declarations)


def _implementations(skill: str, files: Sequence[ParsedFile]) -> list[tuple[s.ImplementationDeclaration, Source]]:
    return [
        (declared, source)
        for declared, source in _declared(files)
        if isinstance(declared, s.ImplementationDeclaration) and declared.skill.text == skill
    ]
