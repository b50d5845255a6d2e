"""Converts declarations of skills, implementations and tasks to boxes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import assert_never

from skillc_compiler.emit.picture.boxes import PictureBox
from skillc_compiler.emit.picture.nodes import NodeDrawer
from skillc_compiler.program.program import ParsedFile
from skillc_dsl import syntax as s
from skillc_dsl.parsing.building.places import TreeBuilder
from skillc_dsl.source import Source


def draw_skill(
    skill: s.SkillDeclaration, source: Source, implementations: Sequence[tuple[s.ImplementationDeclaration, Source]]
) -> PictureBox:
    """Return a skill's conditions above a tree for each implementation, which is given with its source file."""
    places = TreeBuilder(source)
    conditions = tuple(places.written(each.span) for each in skill.members if isinstance(each, s.Requirement))
    ways = tuple(draw_implementation(written, own) for written, own in implementations)
    nothing = (PictureBox("guard", "∅", "no implementation here"),)
    return PictureBox("heading", "◆", f"skill {skill.name.text}", conditions, ways or nothing)


def draw_implementation(written: s.ImplementationDeclaration, source: Source) -> PictureBox:
    """Return the tree of an implementation below its conditions and lets."""
    places = TreeBuilder(source)
    lines: list[str] = []
    bodies: list[PictureBox] = []
    for member in written.members:
        match member:
            case s.Body(node=node):
                bodies.append(NodeDrawer(places).box(node))
            case s.RunPython(target=target):
                bodies.append(PictureBox("code", "λ", "run python", (target.value,)))
            case s.Refinement() | s.Requirement() | s.Duration() | s.Let() | s.Output() | s.Prefer() | s.Verify():
                lines.append(places.written(member.span))
            case _:
                assert_never(member)
    return PictureBox("heading", "◇", f"impl {written.name.text} of {written.skill.text}", tuple(lines), tuple(bodies))


def draw_task(written: s.TaskDeclaration, source: Source) -> PictureBox:
    """Return a task with its scene above its goal or its body."""
    parts: list[PictureBox] = []
    if written.goal is not None:
        parts.append(PictureBox("guard", "⚑", "goal", (written.goal_text,)))
    if written.body is not None:
        parts.append(NodeDrawer(TreeBuilder(source)).box(written.body.node))
    scene = (f'scene "{written.scene.value}"',) if written.scene else ()
    return PictureBox("heading", "◆", f"task {written.name.text}", scene, tuple(parts))


def list_drawable(files: Sequence[ParsedFile]) -> tuple[str, ...]:
    """Return the names of all skills and tasks, in order."""
    kinds = s.SkillDeclaration | s.TaskDeclaration
    return tuple(sorted({each.name.text for each, _ in _declared(files) if isinstance(each, kinds)}))


def make_picture(name: str, files: Sequence[ParsedFile]) -> PictureBox | None:
    """Return the picture of the skill or the task of that name, None if there is neither."""
    for declared, source in _declared(files):
        match declared:
            case s.SkillDeclaration() if declared.name.text == name:
                return draw_skill(declared, source, _implementations(name, files))
            case s.TaskDeclaration() if declared.name.text == name:
                return draw_task(declared, source)
            case _:
                pass
    return None


def _declared(files: Sequence[ParsedFile]) -> Iterator[tuple[s.Declaration, Source]]:
    for unit in files:
        source = Source(unit.file.path, unit.text, edition=unit.edition)
        yield from ((declared, source) for declared in unit.file.declarations)


def _implementations(skill: str, files: Sequence[ParsedFile]) -> list[tuple[s.ImplementationDeclaration, Source]]:
    return [
        (declared, source)
        for declared, source in _declared(files)
        if isinstance(declared, s.ImplementationDeclaration) and declared.skill.text == skill
    ]
