"""What is asked about scenes and the tasks in them, and answered again only if something that it reads has changed.

That is the scene, what planners read of all skills, the task, the skills that it runs with their bodies, the models of
devices and Python. An edit of a body concerns the tasks that run it.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from functools import partial

import pyoxigraph as ox

from skillc.services.cell_checks.verdicts import describe_judgement, judge_cell
from skillc.services.scene.diagnostics import with_shown_path
from skillc_compiler.diagnostics.unplannable import read_views
from skillc_compiler.python.targets import Targets
from skillc_dsl.descriptions.nodes import DECORATOR_OF
from skillc_dsl.diagnostics import Diagnostic, Fix
from skillc_dsl.query import Memo
from skillc_model import tree
from skillc_model.conditions import Condition, Expression
from skillc_model.skills import Compound, Implementation, SkillLibrary, Task
from skillc_model.traversal import find_calls, free_variables
from skillc_model.tree import Node
from skillc_ontology.catalogue import user_models
from skillc_rdf.turtle.statements import Statement
from skillc_rdf.vocabulary.closure import reachable
from skillc_rdf.vocabulary.types import NumberType, Vocabulary
from skillc_runtime.execution.selection.preflight import preflight
from skillc_runtime.execution.selection.refusal import Refusal
from skillc_runtime.execution.selection.select import NoneSelected, explain_none_selected, select_implementation
from skillc_runtime.execution.selection.unsupported import UnsupportedIndividual, unsupported_individuals
from skillc_runtime.planning.reachability import UnreachableGoal, explain_unreachable
from skillc_runtime.scene.load import LoadedScene
from skillc_runtime.scene.violation import SceneViolation
from skillc_runtime.world.eval.expressions import value_of
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.terms import ANGLES
from skillc_runtime.world.state.world_state import WorldState

_DECIMALS = re.compile(r"-?\d*\.(\d{2,})")
"""A number with two decimals or more: a rounded multiple of pi/4 has them, an angle in degrees rarely."""


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
            return tuple(_initial_call_refusals(body, self.library, scene.state))

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


def check_angles(scene: LoadedScene, path: str) -> Iterator[Diagnostic]:
    """Yield warnings for angles in the scene file at `path` that were probably written in the other unit."""
    vocabulary = scene.state.vocabulary
    for each in scene.said:
        if each.lines.path != path or not isinstance(each.object, ox.Literal):
            continue
        if each.predicate in ANGLES:
            yield from _radians_for_degrees(each, each.object.value, vocabulary)
        elif _is_in_radians(each.predicate, vocabulary):
            yield from _degrees_for_radians(each, each.object.value, vocabulary)


def _is_in_radians(property_: str, vocabulary: Vocabulary) -> bool:
    term = vocabulary.properties.get(property_)
    return term is not None and term.type == NumberType("Angle")


def _degrees_for_radians(stated: Statement, written: str, vocabulary: Vocabulary) -> Iterator[Diagnostic]:
    """Yield a warning for more than one turn in rad."""
    angle = float(written)
    if math.isfinite(angle) and abs(angle) > 2 * math.pi:
        message = f"{vocabulary.short(stated.predicate)} is read in rad: this is {abs(angle) / (2 * math.pi):.1f} turns"
        yield _in_the_other_unit(stated, message, f"{written} deg", f"{math.radians(angle):.6g}")


def _radians_for_degrees(stated: Statement, written: str, vocabulary: Vocabulary) -> Iterator[Diagnostic]:
    """Yield a warning for degrees that are a multiple of pi/4 up to 2 pi, rounded to the decimals that are written."""
    decimals = _DECIMALS.fullmatch(written)
    angle = float(written)
    eighths = round(4 * angle / math.pi)
    if decimals and 0 < abs(eighths) <= 8 and round(eighths * math.pi / 4, len(decimals[1])) == angle:
        name = vocabulary.short(stated.predicate)
        message = f"{name} is read in degrees, and {written} is a rounded multiple of pi/4"
        yield _in_the_other_unit(stated, message, f"{written} rad", f"{45 * eighths}")


def _in_the_other_unit(stated: Statement, message: str, meant: str, instead: str) -> Diagnostic:
    span = with_shown_path(stated.object_place)
    fix = Fix(span, instead, f"write `{instead}`", safe=False)
    help_ = f"if it was meant as {meant}, write `{instead}`"
    return Diagnostic("angle-in-other-unit", span, message, help_, "warning", fix=fix)


def _initial_call_refusals(body: tree.Node, library: SkillLibrary, state: WorldState) -> Iterator[Refusal]:
    """Yield why calls cannot start that a body starts with, before anything else can have changed the world."""
    taken = set[Expression]()
    for call in _initial_calls(body):
        used = {call.arguments[name] for name in library.skills[call.skill].uses if name in call.arguments}
        waits, taken = not used.isdisjoint(taken), taken | used
        if waits or any(free_variables(argument) for argument in call.arguments.values()):
            continue
        try:
            arguments = {name: value_of(argument, state, {}) for name, argument in call.arguments.items()}
            chosen = select_implementation(library, call.skill, arguments, state, call.implementation)
        except EvaluationError as error:
            yield Refusal(call.skill, f"{call.skill}: {error}", call.source)
            continue
        if isinstance(chosen, NoneSelected):
            yield Refusal(
                call.skill, explain_none_selected(call.skill, chosen.rejected), call.source, (), chosen.rejected
            )


def _initial_calls(node: tree.Node) -> Iterator[tree.Call]:
    """Yield the calls that start at once and whose failure is the failure of the body."""
    match node:
        case tree.Call():
            yield node
        case tree.Sequence(children=(first, *_)):
            yield from _initial_calls(first)
        case tree.With(call=call):
            yield call
        case tree.Finally(child=child):
            yield from _initial_calls(child)
        case tree.Parallel(children=children, policy="all", after=after):
            for index, child in enumerate(children):
                if not after or not after[index]:
                    yield from _initial_calls(child)
        case _ if isinstance(node, tree.Decorator) and DECORATOR_OF[tree.kind_of(node)].on_failure != "success":
            yield from _initial_calls(node.child)
