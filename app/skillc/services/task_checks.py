"""Checks tasks in their scenes before they run: unreachable goals, calls that cannot start.

Diagnostics have displayable paths, and labels at the individuals that a message names.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TypeAlias

from skillc.extras import install_command, missing_extras
from skillc.services import scene_diagnostics, value_checks
from skillc.services.angle_checks import check_angles
from skillc.services.cell_checks.report import CellJudge, CellProblem, cell_problems, used_individuals
from skillc.services.cell_checks.verdicts import judge_cell
from skillc.services.task_scenes import TaskScenes
from skillc_compiler.program.typed import Program
from skillc_dsl.diagnostics import Diagnostic, Label, Outcome, Severity
from skillc_dsl.source import Span
from skillc_dsl.spelling import did_you_mean
from skillc_model.conditions import Condition
from skillc_model.skills import SkillLibrary, Task
from skillc_rdf.turtle.terms import RDF_TYPE
from skillc_rdf.vocabulary.types import Position
from skillc_runtime.execution.selection.initial_calls import initial_call_refusals
from skillc_runtime.execution.selection.preflight import preflight
from skillc_runtime.execution.selection.refusal import Origin, Refusal
from skillc_runtime.execution.selection.unsupported import UnsupportedIndividual, unsupported_individuals
from skillc_runtime.planning.reachability import UnreachableGoal, explain_unreachable
from skillc_runtime.scene.load import Scene
from skillc_runtime.scene.statements import iri_of
from skillc_runtime.scene.violation import SceneViolation
from skillc_runtime.world.state.terms import CONTAIN, MANIPULATABLE

_NAME = re.compile(r"(?<![\w.-])[\w.-]*:[\w-]+")
LABELLED = 6
"""The most individuals that are labelled in a diagnostic."""
DisplayPath: TypeAlias = Callable[[str], str]
"""Maps the path of a source to a displayable one."""
LONGEST_TASK = 10
"""The most lines between the name of a task and its goal."""


def check_tasks_in_scenes(
    compiled: Outcome[SkillLibrary],
    program: Program,
    scenes: TaskScenes,
    display_path: DisplayPath,
    judge: CellJudge | None = None,
) -> list[Diagnostic]:
    """Return the diagnostics of tasks that cannot succeed, individuals without implementations, and unusable arms.

    What tasks with parameters do depends on their arguments, and is checked when they run. What is wrong in a cell is
    reported there, with the tasks that it stops, and not at these again.

    `program` is the compiled program, `judge` may be a cached `judge_cell`. Libraries and scenes with errors are
    skipped, and so is what compiling has reported. What affects several tasks is reported at the first.
    """
    if not compiled.ok:
        return []
    library = compiled.value
    errors: list[Diagnostic] = []
    places = value_checks.value_places(program)
    known = {name: task for name, task in library.tasks.items() if not task.parameters}
    unchecked = list(_unchecked(scenes.valid))
    judge = _judge_nothing if unchecked else judge or judge_cell
    cells = {path: list(_of_cell(path, scenes, known, judge)) for path in scenes.valid}
    stopped: dict[CellProblem, list[Label]] = {}
    for name, path in scenes.files.items():
        if path in scenes.valid and name in known:
            of_task = _TaskDiagnostics(display_path, scenes.valid[path], known[name])
            found = _of_task(of_task, library, cells[path], places, stopped)
            errors += (each for each in found if not _is_reported(each, compiled.diagnostics))
    errors = list({(each.span, each.name, each.message): each for each in reversed(errors)}.values())[::-1]
    labelled = {(label.span.path, label.span.line) for each in errors for label in each.labels}
    valid = [(scene, str(path)) for path, scene in scenes.valid.items()]
    others = [] if unchecked else [each for scene, path in valid for each in _of_devices(scene, path)]
    others += (each for scene, path in valid for each in _of_individuals(library, scene, path))
    others += (each for scene, path in valid for each in check_angles(scene, path))
    others = [each for each in others if (each.span.path, each.span.line) not in labelled]
    return [*errors, *others, *unchecked, *(_with_tasks(each, stopped) for found in cells.values() for each in found)]


def _unchecked(scenes: Mapping[Path, Scene]) -> Iterator[Diagnostic]:
    """Yield a note, in the first of the scenes, if what looks at space and devices is not installed."""
    if scenes and missing_extras("run"):
        first = next(iter(scenes))
        message = "the numbers of this scene were compared; space, and the Python of primitives, were not looked at"
        help_ = f"install what looks at them: {install_command('run')}"
        yield Diagnostic("unchecked-space", Span(str(first), 1, 1, 1, 1), message, help_, "note")


def _judge_nothing(scene: Scene, goals: Sequence[Condition]) -> tuple[SceneViolation, ...]:
    """Stand for the judge of cells where there is none."""
    return ()


def _of_devices(scene: Scene, path: str) -> Iterator[Diagnostic]:
    """Yield the diagnostics of controllers and data sheets of the arms in a scene."""
    # It needs the simulator, which is slow to import and not always installed.
    from skillc.services.device_checks import check_controllers, check_sheets

    yield from check_controllers(scene, path)
    yield from check_sheets(scene, path)


def _of_cell(path: Path, scenes: TaskScenes, known: Mapping[str, Task], judge: CellJudge) -> Iterator[CellProblem]:
    """Yield what is wrong in the cell of a scene, with regard to the tasks in it."""
    tasks = [known[name] for name, file in scenes.files.items() if file == path and name in known]
    goals = [each.goal for each in tasks if each.goal is not None]
    yield from cell_problems(scenes.valid[path], str(path), _used_in(tasks, scenes.valid[path]), goals, judge)


def _with_tasks(problem: CellProblem, stopped: Mapping[CellProblem, Sequence[Label]]) -> Diagnostic:
    """Return the diagnostic of a problem: an error with labels at the tasks that it stops, if there are any."""
    if problem not in stopped:
        return problem.diagnostic
    labels = (*problem.diagnostic.labels, *stopped[problem])
    return replace(problem.diagnostic, severity="error", labels=labels)


def _used_in(tasks: Sequence[Task], scene: Scene) -> frozenset[str]:
    """Return the individuals that tasks use in their scene."""
    items = [item for task in tasks for item in (task.goal, task.body) if item is not None]
    return frozenset[str]().union(*(used_individuals(item, scene.state) for item in items))


def _is_reported(problem: Diagnostic, compiled: Sequence[Diagnostic]) -> bool:
    """Whether compiling has reported, in the same task, that no skill achieves the goal."""
    goals = [each.span for each in compiled if each.name == "unachievable-goal"]
    first = problem.span
    return problem.name == "unreachable-goal" and any(
        goal.path == first.path and 0 <= goal.line - first.line <= LONGEST_TASK for goal in goals
    )


def _of_task(
    of_task: _TaskDiagnostics,
    library: SkillLibrary,
    cell: Sequence[CellProblem],
    places: Mapping[Origin, Span],
    stopped: dict[CellProblem, list[Label]],
) -> Iterator[Diagnostic]:
    """Yield the diagnostics of a task in its scene; `places` are the spans of values in the source.

    If it is stopped by problems of the cell, labels for these are added to `stopped` instead.
    """
    task, scene = of_task.task, of_task.scene
    if task.goal is not None:
        found = explain_unreachable(library, scene.state, task.goal)
        causes = [] if found is None else _find_causes(found, cell)
        for each in causes:
            stopped.setdefault(each, []).append(of_task.stopped())
        if found is not None and not causes:
            yield of_task.unreachable(found)
    if task.body is not None:
        refusals = preflight(task.body, library, scene.state)
        for refusal in refusals:
            yield from of_task.misnamed(refusal, places) if refusal.unknown_names else (of_task.refusal(refusal),)
        if not refusals:
            yield from (of_task.cannot_start(each) for each in initial_call_refusals(task.body, library, scene.state))


def _find_causes(found: UnreachableGoal, cell: Sequence[CellProblem]) -> list[CellProblem]:
    """Return the problems of a cell because of which a goal is unreachable; none if they do not explain all of it."""
    explained = [[each for each in cell if each.explains(obstacle)] for obstacle in found.obstacles]
    return list(dict.fromkeys(each for causes in explained for each in causes)) if all(explained) else []


def _of_individuals(library: SkillLibrary, scene: Scene, path: str) -> Iterator[Diagnostic]:
    """Yield the diagnostics of individuals in the scene file at `path` that no implementation of a skill accepts."""
    own = {iri_of(each.subject): each for each in reversed(scene.said) if each.predicate == RDF_TYPE}
    here = {iri: each for iri, each in own.items() if each.lines.path == path}
    for each in unsupported_individuals(library, scene.state, frozenset(here)):
        statement = here[each.individual]
        span = scene_diagnostics.with_shown_path(statement.object_place)
        yield Diagnostic("no-implementation-fits", span, _unfit(each, scene), _accepted(each, scene), "warning")


class _TaskDiagnostics:
    """Makes diagnostics about one task."""

    def __init__(self, display_path: DisplayPath, scene: Scene, task: Task) -> None:
        self._display_path, self.scene, self.task = display_path, scene, task

    def stopped(self) -> Label:
        """Return the label at the task for what stops it."""
        return Label(self._span(self.task.source), "this task cannot reach its goal because of it")

    def refusal(self, refusal: Refusal) -> Diagnostic:
        """Return the diagnostic of a call that can never start in the scene."""
        around = f", in {' > '.join(refusal.within)}" if refusal.within else ""
        name = _problem_name(refusal, "no-implementation-fits")
        return self.diagnostic(name, f"{refusal.message}{around}", refusal, "error")

    def misnamed(self, refusal: Refusal, places: Mapping[Origin, Span]) -> Iterator[Diagnostic]:
        """Yield those of the unknown names because of which a call can never start, at the text or at the call."""
        for origin, wrong in refusal.unknown_names.items():
            message = wrong.message(self.scene.state.vocabulary)
            at_call = self.diagnostic("unknown-value", message, replace(refusal, rejected=()), "error")
            written = places.get(origin)
            if written is None:
                yield replace(at_call, help=did_you_mean(wrong.text, wrong.known))
                continue
            span = written._replace(path=self._display_path(written.path))
            labels = (*([Label(at_call.span, "in this task")] if refusal.within else ()), *at_call.labels)
            yield value_checks.unknown_value(wrong, message, span, "error", labels)

    def cannot_start(self, refusal: Refusal) -> Diagnostic:
        """Return the diagnostic of a call that cannot start in the initial state of the scene."""
        message = f"`{self.task.name}` begins with a call that cannot start in this scene: {refusal.message}"
        return self.diagnostic(_problem_name(refusal, "cannot-start"), message, refusal, "warning")

    def unreachable(self, found: UnreachableGoal) -> Diagnostic:
        """Return the diagnostic of an unreachable goal."""
        what = "cannot be reached" if found.proved else "no plan can be made for"
        message = f"`{self.task.name}` has a goal that {what} in its scene: {found.why}"
        place = self._span(self.task.source)
        return Diagnostic(
            "unreachable-goal", place, message, self._missing_place(message), labels=tuple(self._named(message))
        )

    def _missing_place(self, message: str) -> str:
        """Return what to state if a thing that a message names is nowhere, and others of the scene are somewhere."""
        state, short = self.scene.state, self.scene.state.vocabulary.short
        if CONTAIN not in state.vocabulary.relations:
            return ""
        words = set(_NAME.findall(message))
        lost = [each for each in state.instances(MANIPULATABLE) if not state.subjects(CONTAIN, each)]
        named = sorted(short(each) for each in lost if short(each) in words)
        places = Counter(short(place) for place, thing in sorted(state.pairs(CONTAIN)) if thing not in lost)
        if not named or not places:
            return ""
        return f"state where it is, as of other things: `{places.most_common(1)[0][0]} {short(CONTAIN)} {named[0]}`"

    def diagnostic(self, name: str, message: str, refusal: Refusal, severity: Severity) -> Diagnostic:
        """Return a diagnostic at the call, or at the task if the call is inside another skill."""
        labels = [Label(self._span(refusal.source), "this call")] if refusal.within else []
        labels += (Label(self._span(each.source), f"asked here by {each.implementation}") for each in refusal.rejected)
        labels += self._named(message)
        place = self.task.source if refusal.within else refusal.source
        return Diagnostic(name, self._span(place), message, "", severity, tuple(dict.fromkeys(labels)))

    def _named(self, message: str) -> list[Label]:
        """Return labels at the declarations of the individuals that a message names."""
        short = self.scene.state.vocabulary.short
        words = set(_NAME.findall(message))
        typed = {iri_of(each.subject): each for each in reversed(self.scene.said) if each.predicate == RDF_TYPE}
        found = sorted(each.subject_place for iri, each in typed.items() if short(iri) in words)
        return [Label(scene_diagnostics.with_shown_path(place), "this one") for place in found[:LABELLED]]

    def _span(self, place: Position) -> Span:
        path = self._display_path(place.path)
        return Span(path, place.line, place.column, place.line, place.column + 1)


def _problem_name(refusal: Refusal, otherwise: str) -> str:
    """Return the name of the diagnostic: of inferred parameters, of preconditions, or `otherwise`."""
    stages = {each.stage for each in refusal.rejected}
    if stages != {"inference"}:
        return "cannot-start" if stages == {"pre"} else otherwise
    return "several-answers" if any(" may be " in each.reason for each in refusal.rejected) else "no-answer"


def _unfit(each: UnsupportedIndividual, scene: Scene) -> str:
    short = scene.state.vocabulary.short
    classes = " and a ".join(sorted(map(short, scene.state.types(each.individual))))
    return f"no implementation of {', '.join(sorted(each.skills))} fits {short(each.individual)}, a {classes}"


def _accepted(each: UnsupportedIndividual, scene: Scene) -> str:
    classes = sorted({scene.state.vocabulary.short(cls) for accepted in each.skills.values() for cls in accepted})
    return f"there are implementations for {', '.join(classes)}; or add `impl .. of {min(each.skills)}`"
