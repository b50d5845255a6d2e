"""Makes diagnostics about a task in its scene, with labels at the individuals that a message names."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import TypeAlias

from msgspec import structs

from skillc.services.scene import diagnostics as scene_diagnostics
from skillc.services.tasks import value_checks
from skillc.services.tasks.space_problems import OutOfTime, SpaceProblem
from skillc_dsl.diagnostics import Diagnostic, Label, Severity
from skillc_dsl.position import Position
from skillc_dsl.source import Span
from skillc_dsl.spelling import did_you_mean
from skillc_model.skills import Task
from skillc_model.traversal import find_calls
from skillc_rdf.turtle.terms import RDF_TYPE
from skillc_runtime.execution.selection.refusal import Origin, Refusal
from skillc_runtime.planning.reachability import UnreachableGoal
from skillc_runtime.scene.load import LoadedScene
from skillc_runtime.scene.ontology_individuals import PATH as ONTOLOGIES
from skillc_runtime.scene.statements import iri_of
from skillc_runtime.world.state.terms import CONTAIN, MANIPULATABLE

_NAME = re.compile(r"(?<![\w.-])[\w.-]*:[\w-]+")
LABELLED = 6
"""The most individuals that are labelled in a diagnostic."""
DisplayPath: TypeAlias = Callable[[str], str]
"""Maps the path of a source to a displayable one."""


@dataclass(frozen=True, slots=True)
class StoppedTask:
    """A task that something in its cell stops: the label at the task, and what would help it, empty if not known."""

    label: Label
    cure: str = ""


class TaskDiagnostics:
    """Makes diagnostics about one task."""

    def __init__(self, display_path: DisplayPath, scene: LoadedScene, task: Task) -> None:
        self._display_path, self.scene, self.task = display_path, scene, task

    def stopped(self, found: SpaceProblem | None = None) -> StoppedTask:
        """Return what is said of the task at what stops it, which a look in space may have found."""
        what = "cannot reach its goal" if self.task.goal is not None else "does not go on from here"
        place = self.task.source if found is None else self._place_of(found)
        return StoppedTask(Label(self._span(place), f"this task {what} because of it"), found.cure if found else "")

    def refusal(self, refusal: Refusal) -> Diagnostic:
        """Return the diagnostic of a call that can never start in the scene."""
        around = f", in {' > '.join(refusal.within)}" if refusal.within else ""
        name = _problem_name(refusal, "no-implementation-fits")
        return self.diagnostic(name, f"{refusal.message}{around}", refusal, "error")

    def misnamed(self, refusal: Refusal, places: Mapping[Origin, Span]) -> Iterator[Diagnostic]:
        """Yield those of the unknown names because of which a call can never start, at the text or at the call."""
        for origin, wrong in refusal.unknown_names.items():
            message = wrong.message(self.scene.state.vocabulary)
            at_call = self.diagnostic("unknown-value", message, structs.replace(refusal, rejected=()), "error")
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

    def broken(self, why: str) -> Diagnostic:
        """Return the diagnostic of a task in whose scene something does not hold that is to hold always."""
        message = f"`{self.task.name}` does not begin in this scene: {why}"
        place = self._span(self.task.source)
        return Diagnostic("cannot-start", place, message, "", "warning", tuple(self._named(message)))

    def unreachable(self, found: UnreachableGoal) -> Diagnostic:
        """Return the diagnostic of an unreachable goal."""
        what = "cannot be reached" if found.proved else "no plan can be made for"
        message = f"`{self.task.name}` has a goal that {what} in its scene: {found.why}"
        place = self._span(self.task.source)
        return Diagnostic(
            "unreachable-goal", place, message, self._missing_place(message), labels=tuple(self._named(message))
        )

    def infeasible(self, found: SpaceProblem) -> Diagnostic:
        """Return the diagnostic of a step that does not go in space, at its call, or at the task if it was planned."""
        if found.displaced:
            return self._tight(found)
        name, place = self.task.name, self._place_of(found)
        message = f"{found.step} does not go in space: {found.why}"
        if self.task.goal is not None and found.certain:
            message = f"no plan for `{name}` goes in space: {found.step} does not go: {found.why}"
        help_ = found.cure or ("" if found.certain else "nothing proves that it cannot go in another way")
        severity: Severity = "error" if found.certain else "warning"
        labels = tuple(self._named(message))
        return Diagnostic("infeasible-step", self._span(place), message, help_, severity, labels)

    def _tight(self, found: SpaceProblem) -> Diagnostic:
        """Return the diagnostic of a step that goes where the scene has a thing, but not all over where it may be."""
        message = (
            f"{found.step} goes where the scene has it, but not everywhere within its offsetRange and tiltRange: "
            f"{found.displaced}, {found.why}"
        )
        labels, help_ = tuple(self._named(message)), found.cure or "move it, or state how well its place is known"
        return Diagnostic("infeasible-step", self._span(self._place_of(found)), message, help_, "warning", labels)

    def _place_of(self, found: SpaceProblem) -> Position:
        if found.call is None or self.task.body is None:
            return self.task.source
        return list(find_calls(self.task.body))[found.call].source

    def names(self, found: SpaceProblem, individuals: Iterable[str]) -> bool:
        """Whether the message about a step names one of some individuals."""
        short = self.scene.state.vocabulary.short
        return not {*_NAME.findall(f"{found.step} {found.why}")}.isdisjoint(map(short, individuals))

    def unlooked(self, given_up: OutOfTime) -> Diagnostic:
        """Return the note that a task was not looked at in space to the end."""
        message = f"`{self.task.name}` was not looked at in space: it takes more than {given_up.after_s:g} s"
        help_ = f"`skillc plan {self.task.name}` looks at it for longer" if self.task.goal is not None else ""
        return Diagnostic("unchecked-space", self._span(self.task.source), message, help_, "note")

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
        said = (each for each in reversed(self.scene.said) if each.lines.path != ONTOLOGIES)
        typed = {iri_of(each.subject): each for each in said if each.predicate == RDF_TYPE}
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
