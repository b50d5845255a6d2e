"""From what an author wrote to boxes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import assert_never

from skillc_compiler.emit.picture.boxes import Box
from skillc_compiler.emit.picture.nodes import Nodes
from skillc_dsl import syntax as s
from skillc_dsl.parsing.building.places import TreeBuilder
from skillc_dsl.source import Source


def skill_box(
    skill: s.SkillDeclaration, source: Source, implementations: Sequence[tuple[s.ImplementationDeclaration, Source]]
) -> Box:
    """Return a skill's conditions over a tree for each implementation; each comes with the text it was written in."""
    places = TreeBuilder(source)
    conditions = tuple(places.written(each.span) for each in skill.members if isinstance(each, s.Requirement))
    ways = tuple(implementation_box(written, own) for written, own in implementations)
    nothing = (Box("guard", "∅", "no implementation here"),)
    return Box("heading", "◆", f"skill {skill.name.text}", conditions, ways or nothing)


def implementation_box(written: s.ImplementationDeclaration, source: Source) -> Box:
    """Return the tree of an implementation under what it demands and the values it names."""
    places = TreeBuilder(source)
    lines: list[str] = []
    bodies: list[Box] = []
    for member in written.members:
        match member:
            case s.Body(node=node):
                bodies.append(Nodes(places).box(node))
            case s.RunPython(target=target):
                bodies.append(Box("code", "λ", "run python", (target.value,)))
            case s.Refinement() | s.Requirement() | s.Duration() | s.Let() | s.Prefer() | s.Verify():
                lines.append(places.written(member.span))
            case _:
                assert_never(member)
    return Box("heading", "◇", f"impl {written.name.text} of {written.skill.text}", tuple(lines), tuple(bodies))


def task_box(written: s.TaskDeclaration, source: Source) -> Box:
    """Return a task with its scene over its goal or its body."""
    parts: list[Box] = []
    if written.goal is not None:
        parts.append(Box("guard", "⚑", "goal", (written.goal_text,)))
    if written.body is not None:
        parts.append(Nodes(TreeBuilder(source)).box(written.body.node))
    scene = (f'scene "{written.scene.value}"',) if written.scene else ()
    return Box("heading", "◆", f"task {written.name.text}", scene, tuple(parts))
