"""A skill that no task of the library can reach."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Implementation, Skill, TypedNode
from skillc_compiler.program.walk import nodes_in
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic
from skillc_rdf.vocabulary.closure import reachable

NAMES = ("unreachable-skill",)
NEEDS = Need.PROGRAM
READS = Reads.LIBRARY


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a warning for each skill that no task reaches, in a library with tasks."""
    own = [unit for unit in program.files if unit.library == program.name]
    declared = [each for unit in own for each in unit.file.declarations if isinstance(each, s.TaskDeclaration)]
    if all(isinstance(each, s.TestDeclaration) for each in declared):
        return
    reached = _reached_skills(program)
    paths = {unit.file.path for unit in own}
    for skill in program.skills.values():
        reported = not program.implementations_of[skill.name] or _achieves_nothing(skill)
        if skill.name not in reached and skill.name_span.path in paths and not reported:
            yield Diagnostic(
                "unreachable-skill",
                skill.name_span,
                f"no task of this library can reach `{skill.name}`",
                help="call it, give it a `post` for which it can be planned, or remove it",
                severity="warning",
            )


def _reached_skills(program: Program) -> set[str]:
    start = [name for task in program.tasks if task.body for name in _called_skills(task.body)]
    if any(task.goal for task in program.tasks):
        start += [skill.name for skill in program.skills.values() if _is_planned(skill)]
    return reachable(start, lambda name: (each for one in program.implementations_of[name] for each in _calls(one)))


def _is_planned(skill: Skill) -> bool:
    return "noplan" not in skill.flags and not _achieves_nothing(skill)


def _achieves_nothing(skill: Skill) -> bool:
    """Whether a planned skill has no post, which is a problem of its own."""
    return "noplan" not in skill.flags and not any(r.says_what_comes for r in skill.requirements)


def _calls(implementation: Implementation) -> Iterator[str]:
    return _called_skills(implementation.body) if isinstance(implementation.body, TypedNode) else iter(())


def _called_skills(body: TypedNode) -> Iterator[str]:
    return (node.call.skill.name for node in nodes_in(body) if node.call and node.call.skill)
