"""Checks tasks in their scenes before they run: unreachable goals, calls that cannot start.

Diagnostics have displayable paths, and labels at the individuals that a message names.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from skillc.extras import install_command, missing_extras
from skillc.services.cell_checks.report import CellProblem, ScenePlaces, grade, locate, used_individuals
from skillc.services.check.scene_queries import SceneQueries
from skillc.services.scene import diagnostics as scene_diagnostics
from skillc.services.tasks import value_checks
from skillc.services.tasks.diagnostics import DisplayPath, StoppedTask, TaskDiagnostics
from skillc.services.tasks.scenes import TaskScenes
from skillc.services.tasks.space_problems import OutOfTime, SpaceJudge, SpaceProblem
from skillc_compiler.program.program import Program
from skillc_dsl.diagnostics import Diagnostic, Outcome
from skillc_dsl.query import Memo
from skillc_dsl.source import Span
from skillc_model.declared import act_as_declared
from skillc_model.skills import SkillLibrary, Task
from skillc_rdf.turtle.terms import RDF_TYPE
from skillc_runtime.execution.selection.refusal import Origin
from skillc_runtime.execution.selection.unsupported import UnsupportedIndividual
from skillc_runtime.planning.objectives.always import find_broken_at_start
from skillc_runtime.planning.reachability import UnreachableGoal
from skillc_runtime.scene.load import LoadedScene
from skillc_runtime.scene.statements import iri_of

LONGEST_TASK = 10
"""The most lines between the name of a task and its goal."""


def check_tasks_in_scenes(
    compiled: Outcome[SkillLibrary],
    program: Program,
    scenes: TaskScenes,
    display_path: DisplayPath,
    memo: Memo,
    look: SpaceJudge | None = None,
) -> list[Diagnostic]:
    """Return the diagnostics of tasks that cannot succeed, individuals without implementations, and unusable arms.

    What tasks with parameters do depends on their arguments, and is checked when they run. What is wrong in a cell is
    reported there, with the tasks that it stops, and not at these again.

    `program` is the compiled program, `memo` has what is known of it and its scenes. `look` looks in space at
    tasks of which nothing else is reported, and no error in their scenes: what certainly does not go is an error, at
    what is wrong in the cell if the same is said there, else at the task. Libraries and scenes with errors are skipped,
    and so is what compiling has reported. What affects several tasks is reported at the first. Of tasks in cells
    without bodies only facts are asked.
    """
    if not compiled.ok:
        return []
    library = compiled.value
    with_bodies = {path: scene for path, scene in scenes.valid.items() if not scene.state.vocabulary.symbolic}
    spatial = SceneQueries(library, memo)
    is_mixed = scenes.bodiless or len(with_bodies) < len(scenes.valid)
    factual = SceneQueries(act_as_declared(library), memo) if is_mixed else spatial
    errors: list[Diagnostic] = []
    fine: list[TaskDiagnostics] = []
    places = value_checks.value_places(program)
    known = {name: task for name, task in library.tasks.items() if not task.parameters}
    unchecked = list(_unchecked(with_bodies))
    cells = {path: [] if unchecked else list(_of_cell(path, scenes, known, spatial)) for path in with_bodies}
    stopped: dict[CellProblem, list[StoppedTask]] = {}
    for name, path in scenes.files.items():
        if path in scenes.valid and name in known:
            is_factual = name in scenes.bodiless
            of_task, cell = TaskDiagnostics(display_path, scenes.valid[path], known[name]), cells.get(path, [])
            asked = factual if is_factual else spatial
            found = list(_of_task(of_task, asked, [] if is_factual else cell, places, stopped))
            errors += (each for each in found if not _is_reported(each, compiled.diagnostics))
            broken = any(each.diagnostic.severity == "error" for each in cell)
            fine += [] if found or broken or is_factual else [of_task]
    errors = list({(each.span, each.name, each.message): each for each in reversed(errors)}.values())[::-1]
    labelled = {(label.span.path, label.span.line) for each in errors for label in each.labels}
    valid = [(scene, str(path)) for path, scene in with_bodies.items()]
    others = [] if unchecked else [each for scene, path in valid for each in spatial.check_devices(scene, path)]
    for path, scene in scenes.valid.items():
        others += _of_individuals(spatial if path in with_bodies else factual, scene, str(path))
    others += (each for scene, path in valid for each in spatial.check_angles(scene, path))
    others = [each for each in others if (each.span.path, each.span.line) not in labelled]
    unusable = {each.span.path for each in others if each.severity == "error"}
    usable = [each for each in fine if str(scenes.files[each.task.name]) not in unusable]
    seen = [] if look is None or unchecked else list(_in_space(usable, library, look, scenes, cells, stopped))
    of_cells = (_with_tasks(each, stopped) for found in cells.values() for each in found)
    return [*errors, *others, *unchecked, *seen, *of_cells]


def _unchecked(scenes: Mapping[Path, LoadedScene]) -> Iterator[Diagnostic]:
    """Yield a note, in the first of the scenes, if what looks at space and devices is not installed."""
    if scenes and missing_extras("run"):
        first = next(iter(scenes))
        message = "the numbers of this scene were compared; space, and the Python of primitives, were not looked at"
        help_ = f"install what looks at them: {install_command('run')}"
        yield Diagnostic("unchecked-space", Span(str(first), 1, 1, 1, 1), message, help_, "note")


def _in_space(
    tasks: Iterable[TaskDiagnostics],
    library: SkillLibrary,
    look: SpaceJudge,
    scenes: TaskScenes,
    cells: Mapping[Path, Sequence[CellProblem]],
    stopped: dict[CellProblem, list[StoppedTask]],
) -> Iterator[Diagnostic]:
    """Yield the diagnostics of steps that do not go in space, and a note if there is no time for all tasks.

    Of what certainly does not go, tasks are added to `stopped` if the same is said of their cell. What is not certain
    is left out if anything is said of an individual that the step names.
    """
    late: list[Diagnostic] = []
    for each in tasks:
        cell = cells[scenes.files[each.task.name]]
        match look(library, each.scene, each.task):
            case SpaceProblem(certain=True) as found:
                same = [problem for problem in cell if problem.violation.message in found.why]
                for problem in same:
                    stopped.setdefault(problem, []).append(each.stopped(found))
                yield from () if same else (each.infeasible(found),)
            case SpaceProblem() as found if not each.names(found, (problem.violation.individual for problem in cell)):
                yield each.infeasible(found)
            case OutOfTime() as given_up:
                late.append(each.unlooked(given_up))
            case _:
                pass
    yield from late[:1]


def _of_cell(path: Path, scenes: TaskScenes, known: Mapping[str, Task], asked: SceneQueries) -> Iterator[CellProblem]:
    """Yield what is wrong in the cell of a scene, with regard to the tasks in it."""
    tasks = [known[name] for name, file in scenes.files.items() if file == path and name in known]
    scene = scenes.valid[path]
    found = asked.judge(str(path), scene, [each.goal for each in tasks if each.goal is not None])
    yield from locate(grade(found, _used_in(tasks, scene)), ScenePlaces.of(scene.said, str(path)))


def _with_tasks(problem: CellProblem, stopped: Mapping[CellProblem, Sequence[StoppedTask]]) -> Diagnostic:
    """Return the diagnostic of a problem: an error with labels at the tasks that it stops, if there are any.

    Its help is the first that was computed for one of them, if one was.
    """
    if problem not in stopped:
        return problem.diagnostic
    labels = (*problem.diagnostic.labels, *(each.label for each in stopped[problem]))
    help_ = next((each.cure for each in stopped[problem] if each.cure), problem.diagnostic.help)
    return replace(problem.diagnostic, severity="error", labels=labels, help=help_)


def _used_in(tasks: Sequence[Task], scene: LoadedScene) -> frozenset[str]:
    """Return the individuals that tasks use in their scene."""
    items = [item for task in tasks for item in (task.goal, task.body, *task.always) if item is not None]
    return frozenset[str]().union(*(used_individuals(item, scene.state) for item in items))


def _is_reported(problem: Diagnostic, compiled: Sequence[Diagnostic]) -> bool:
    """Whether compiling has reported, in the same task, that no skill achieves the goal."""
    goals = [each.span for each in compiled if each.name == "unachievable-goal"]
    first = problem.span
    return problem.name == "unreachable-goal" and any(
        goal.path == first.path and 0 <= goal.line - first.line <= LONGEST_TASK for goal in goals
    )


def _of_task(
    of_task: TaskDiagnostics,
    asked: SceneQueries,
    cell: Sequence[CellProblem],
    places: Mapping[Origin, Span],
    stopped: dict[CellProblem, list[StoppedTask]],
) -> Iterator[Diagnostic]:
    """Yield the diagnostics of a task in its scene; `places` are the spans of values in the source.

    If it is stopped by problems of the cell, labels for these are added to `stopped` instead.
    """
    task, scene = of_task.task, of_task.scene
    broken = None if task.parameters else find_broken_at_start(task.always, scene.state)
    if broken is not None:
        yield of_task.broken(broken)
    if task.goal is not None:
        found = asked.explain_unreachable(scene, task, task.goal)
        causes = [] if found is None else _find_causes(found, cell)
        for each in causes:
            stopped.setdefault(each, []).append(of_task.stopped())
        if found is not None and not causes:
            yield of_task.unreachable(found)
    if task.body is not None:
        refusals = asked.refuse(scene, task.body)
        for refusal in refusals:
            yield from of_task.misnamed(refusal, places) if refusal.unknown_names else (of_task.refusal(refusal),)
        if not refusals:
            yield from (of_task.cannot_start(each) for each in asked.refuse_first_calls(scene, task.body))


def _find_causes(found: UnreachableGoal, cell: Sequence[CellProblem]) -> list[CellProblem]:
    """Return the problems of a cell because of which a goal is unreachable; none if they do not explain all of it."""
    explained = [[each for each in cell if each.explains(obstacle)] for obstacle in found.obstacles]
    return list(dict.fromkeys(each for causes in explained for each in causes)) if all(explained) else []


def _of_individuals(asked: SceneQueries, scene: LoadedScene, path: str) -> Iterator[Diagnostic]:
    """Yield the diagnostics of individuals in the scene file at `path` that no implementation of a skill accepts."""
    own = {iri_of(each.subject): each for each in reversed(scene.said) if each.predicate == RDF_TYPE}
    here = {iri: each for iri, each in own.items() if each.lines.path == path}
    for each in asked.find_unsupported(scene, path, frozenset(here)):
        statement = here[each.individual]
        span = scene_diagnostics.with_shown_path(statement.object_place)
        yield Diagnostic("no-implementation-fits", span, _unfit(each, scene), _accepted(each, scene), "warning")


def _unfit(each: UnsupportedIndividual, scene: LoadedScene) -> str:
    short = scene.state.vocabulary.short
    classes = " and a ".join(sorted(map(short, scene.state.types(each.individual))))
    return f"no implementation of {', '.join(sorted(each.skills))} fits {short(each.individual)}, a {classes}"


def _accepted(each: UnsupportedIndividual, scene: LoadedScene) -> str:
    classes = sorted({scene.state.vocabulary.short(cls) for accepted in each.skills.values() for cls in accepted})
    return f"there are implementations for {', '.join(classes)}; or add `impl .. of {min(each.skills)}`"
