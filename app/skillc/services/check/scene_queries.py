"""What is asked about scenes and the tasks in them, and answered again only if something that it reads has changed.

That is the scene, what planners read of all skills, the task, the skills that it runs with their bodies, the models of
devices and Python. An edit of a body concerns the tasks that run it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

from skillc.services.cell_checks.verdicts import describe_judgement, judge_cell
from skillc.services.check.angle_checks import check_angles
from skillc_compiler.diagnostics.unplannable import read_views
from skillc_compiler.python.targets import Targets
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.query import Memo
from skillc_model.conditions import Condition
from skillc_model.skills import Compound, Implementation, SkillLibrary, Task
from skillc_model.traversal import find_calls
from skillc_model.tree import Node
from skillc_ontology.catalogue import user_models
from skillc_rdf.vocabulary.closure import reachable
from skillc_runtime.execution.selection.initial_calls import initial_call_refusals
from skillc_runtime.execution.selection.preflight import preflight
from skillc_runtime.execution.selection.refusal import Refusal
from skillc_runtime.execution.selection.unsupported import UnsupportedIndividual, unsupported_individuals
from skillc_runtime.planning.reachability import UnreachableGoal, explain_unreachable
from skillc_runtime.scene.load import LoadedScene
from skillc_runtime.scene.violation import SceneViolation


class SceneQueries:
    """Answers questions about the scenes of a library that has no errors."""

    def __init__(self, library: SkillLibrary, memo: Memo) -> None:
        self.library, self._memo = library, memo
        around = memo.same("around scenes", "", (memo.around, tuple(_states_of_models())))
        self._around = around, memo.ask("targets", (), Targets).version
        vocabulary = memo.same("vocabulary of scenes", library.vocabulary.symbolic, library.vocabulary)
        self._read = *self._around, read_views(library, memo), vocabulary

    def judge(self, path: str, scene: LoadedScene, goals: Sequence[Condition]) -> tuple[SceneViolation, ...]:
        """Return what is wrong with the things in the cell of the scene file at `path`, also because of goals."""
        wanted = self._memo.same("goals", path, tuple(goals))
        saved = partial(describe_judgement, scene, goals)
        return self._memo.ask("cell", (*self._around, scene, wanted), partial(judge_cell, scene, goals), saved=saved)

    def explain_unreachable(self, scene: LoadedScene, task: Task, goal: Condition) -> UnreachableGoal | None:
        """Return why no plan reaches the goal of a task, None if one may."""
        wanted = self._memo.same("goal", task.name, goal)
        explain = partial(explain_unreachable, self.library, scene.state, goal)
        return self._memo.ask("unreachable", (*self._read, scene, wanted), explain)

    def refuse(self, scene: LoadedScene, body: Node) -> tuple[Refusal, ...]:
        """Return why a body cannot run."""
        find = partial(preflight, body, self.library, scene.state)
        return self._memo.ask("refusals", (*self._read, scene, body, *self._run_by(body)), find)

    def refuse_first_calls(self, scene: LoadedScene, body: Node) -> tuple[Refusal, ...]:
        """Return the calls with which a body begins that cannot start."""

        def find() -> tuple[Refusal, ...]:
            return tuple(initial_call_refusals(body, self.library, scene.state))

        return self._memo.ask("first calls", (*self._read, scene, body, *self._run_by(body)), find)

    def find_unsupported(
        self, scene: LoadedScene, path: str, here: frozenset[str]
    ) -> tuple[UnsupportedIndividual, ...]:
        """Return those individuals in the scene file at `path`, stated `here`, that no implementation accepts."""

        def find() -> tuple[UnsupportedIndividual, ...]:
            return tuple(unsupported_individuals(self.library, scene.state, here))

        return self._memo.ask("unsupported", (*self._read, scene), find, name=path)

    def check_devices(self, scene: LoadedScene, path: str) -> tuple[Diagnostic, ...]:
        """Return the diagnostics of controllers and data sheets of the arms in a scene."""

        def find() -> tuple[Diagnostic, ...]:
            # It needs the simulator, which is slow to import and not always installed.
            from skillc.services.check.device_checks import check_controllers, check_sheets

            return (*check_controllers(scene, path), *check_sheets(scene, path))

        return self._memo.ask("devices", (*self._around, scene), find, name=path)

    def check_angles(self, scene: LoadedScene, path: str) -> tuple[Diagnostic, ...]:
        """Return the diagnostics of angles in the scene file at `path`."""
        return self._memo.ask("angles", (scene,), lambda: tuple(check_angles(scene, path)), name=path)

    def _run_by(self, body: Node) -> Iterator[object]:
        """Yield the skills and implementations that a body runs, directly or by others."""
        library = self.library

        def called(skill: str) -> Iterator[str]:
            for each in library.implementations_of(skill):
                yield from self._memo.ask("calls", (each,), partial(_calls_of, each))

        names = (call.skill for call in find_calls(body) if call.skill in library.skills)
        for name in sorted(reachable(names, called)):
            yield from (library.skills[name], *library.implementations_of(name))


def _calls_of(implementation: Implementation) -> tuple[str, ...]:
    body = implementation.body
    return tuple(call.skill for call in find_calls(body.node)) if isinstance(body, Compound) else ()


def _states_of_models() -> Iterator[tuple[str, int, int]]:
    for model in user_models():
        state = model.stat()
        yield str(model), state.st_size, state.st_mtime_ns
