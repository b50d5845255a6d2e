"""Checks a library with the scenes of its tasks, and further scenes with it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from skillc.services.library import libraries
from skillc.services.library.bodiless import list_backends, without_unasked
from skillc.services.library.files import LibraryFiles
from skillc.services.reporting.reporter import sort_diagnostics
from skillc.services.tasks.value_checks import check_values
from skillc_compiler.diagnostics.suppressions import without_suppressed
from skillc_compiler.program.program import Program
from skillc_dsl.diagnostics import Diagnostic, Outcome
from skillc_dsl.query import Memo
from skillc_dsl.source import Source
from skillc_dsl.spelling import did_you_mean
from skillc_model.declared import act_as_declared
from skillc_model.skills import SkillLibrary

if TYPE_CHECKING:
    from skillc.services.tasks.scenes import TaskScenes
    from skillc.services.tasks.space_problems import SpaceJudge


class Checked(NamedTuple):
    """The diagnostics of a library, its program, and what it is compiled to; both are None if it has errors.

    `of_scenes` are those of the diagnostics that compiling does not find, `scenes` what was read for tasks.
    """

    diagnostics: tuple[Diagnostic, ...]
    program: Program | None = None
    library: SkillLibrary | None = None
    of_scenes: tuple[Diagnostic, ...] = ()
    scenes: TaskScenes | None = None


def check_library(library: LibraryFiles, scene: Path | None) -> tuple[Diagnostic, ...]:
    """Return the diagnostics of a library, of its tasks' scenes and of `scene`, with displayable paths."""
    return check_whole(library, scene, Memo()).diagnostics


def check_whole(library: LibraryFiles, scene: Path | None, memo: Memo, look: SpaceJudge | None = None) -> Checked:
    """Check a library as `check_library` does, and return also its program if it compiles without errors.

    `look` looks at tasks in space; without it nothing does.
    """
    found = _SceneReader(library, () if scene is None else (scene,))
    outcome = libraries.compile_library(library, found.individuals, memo)
    assert found.program is not None, "a compiled library has a program"
    sources = [each._replace(path=library.display_path(each.path)) for each in library.sources]
    around = check_with_scenes(outcome, found.program, found.scenes, library.display_path, sources, memo, look)
    of_scenes = (*around, *_named_goals(library, outcome, look))
    asked = without_unasked(outcome.diagnostics, list_backends(found.program), library.is_symbolic)
    problems = sort_diagnostics((*asked, *of_scenes))
    if not outcome.ok:
        return Checked(problems)
    return Checked(problems, found.program, outcome.value, of_scenes, found.scenes)


def _named_goals(
    library: LibraryFiles, compiled: Outcome[SkillLibrary], look: SpaceJudge | None
) -> tuple[Diagnostic, ...]:
    """Return the diagnostics of the goals that the manifest names; none if the library has errors."""
    if library.project is None or not library.project.manifest.tasks or not compiled.ok:
        return ()
    from skillc.services.tasks.named_goals import check_named_goals

    if library.is_symbolic():
        return tuple(check_named_goals(library.project, act_as_declared(compiled.value)))
    return tuple(check_named_goals(library.project, compiled.value, look))


def check_with_scenes(
    compiled: Outcome[SkillLibrary],
    program: Program,
    scenes: TaskScenes | None,
    display_path: Callable[[str], str],
    sources: Iterable[Source],
    memo: Memo,
    look: SpaceJudge | None = None,
) -> tuple[Diagnostic, ...]:
    """Return the diagnostics of scenes, of tasks in them, of text values that name nothing, and of back ends.

    `display_path` maps a path of the library to a displayable one. Diagnostics that the `sources` (with displayable
    paths) suppress are omitted.
    """
    found: tuple[Diagnostic, ...] = ()
    if scenes is not None:
        from skillc.services.check.task_checks import check_tasks_in_scenes

        of_tasks = check_tasks_in_scenes(compiled, program, scenes, display_path, memo, look)
        found = (*scenes.problems, *of_tasks)
    values = check_values(compiled, program, scenes, found, display_path)
    return without_suppressed((*found, *values, *_find_unknown_backends(program, display_path)), sources)


def _find_unknown_backends(program: Program, display_path: Callable[[str], str]) -> Iterator[Diagnostic]:
    """Yield the diagnostics of back ends that the library's own tasks name and that are not installed."""
    own = {unit.file.path for unit in program.files if unit.library == program.name}
    named = [each.backend for each in program.tasks if each.backend is not None and each.span.path in own]
    if not named:
        return
    from skillc.services.project.backends import list_backends

    installed = list_backends()
    for name in named:
        if name.text not in installed:
            span = name.span._replace(path=display_path(name.span.path))
            message = f"there is no back end `{name.text}` here"
            help_ = did_you_mean(name.text, installed) or f"there is {', '.join(f'`{each}`' for each in installed)}"
            yield Diagnostic("unknown-backend", span, message, help_)


class _SceneReader:
    """Reads the scenes of a program's tasks, and others, when the compiler asks for their individuals.

    Reading scenes imports the world model, so it is done only if there are scenes.
    """

    def __init__(self, library: LibraryFiles, others: Sequence[Path]) -> None:
        self._library, self._others = library, others
        self.program: Program | None = None
        self.scenes: TaskScenes | None = None

    def individuals(self, program: Program) -> Mapping[str, Mapping[str, Sequence[str]]]:
        """Read the scenes; return the individuals that each task may name, with their classes."""
        self.program = program
        by_default = self._library.project is not None and self._library.project.manifest.scene is not None
        if not self._others and not any(task.scene or by_default for task in program.tasks):
            return {}
        from skillc.services.tasks import scenes as task_scenes

        self.scenes = task_scenes.read_task_scenes(program, task_scenes.SceneTexts.of(self._library), self._others)
        return self.scenes.individuals
