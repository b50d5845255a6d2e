"""Events as lines of text: what a task does, how its steps end, what changes in the world."""

from __future__ import annotations

from collections.abc import Iterator
from typing import assert_never

from skillc_rdf.vocabulary.types import local_name
from skillc_runtime.devices.disturbances import Disturbance, LoseArm, MoveThing, PressEmergencyStop, PushArm, TakeThing
from skillc_runtime.recording import events
from skillc_runtime.recording.contact import SENTENCES
from skillc_runtime.recording.envelope import Envelope
from skillc_runtime.recording.failure import Failure
from skillc_runtime.recording.failure_text import describe_failure
from skillc_runtime.recording.known_facts import format_false_claim, format_status
from skillc_runtime.world.state.labels.labelled import IndividualAdded, IndividualRemoved, LabelledChange
from skillc_runtime.world.state.labels.labelled_text import format_fact, format_value


def describe_disturbance(disturbance: Disturbance) -> str:
    """Return what happened to a cell."""
    match disturbance:
        case PushArm(arm=arm, force_n=force, duration_s=seconds):
            return f"somebody pushes {local_name(arm)} with ({_list(force)}) N for {seconds:g} s"
        case MoveThing(thing=thing, by_m=by, turn_rad=turn):
            return f"somebody moves {local_name(thing)} by ({_list(by)}) m and turns it by {turn:g} rad"
        case TakeThing(thing=thing, by_m=by):
            return f"somebody takes {local_name(thing)} out of the hand and puts it ({_list(by)}) m beside"
        case PressEmergencyStop(pressed=pressed):
            return f"somebody {'presses' if pressed else 'releases'} the emergency stop"
        case LoseArm(arm=arm, lost=lost):
            return f"{local_name(arm)} {'does not answer' if lost else 'answers again'}"
        case _:
            assert_never(disturbance)


def _list(numbers: tuple[float, float, float]) -> str:
    return ", ".join(f"{each:g}" for each in numbers)


class EventLines:
    """Formats the events of one operation in their order."""

    def __init__(self) -> None:
        self._depths: dict[int, int] = {0: 0}
        self._calls: dict[int, int] = {}

    def format(self, envelope: Envelope) -> Iterator[str]:
        """Yield the line of an event: its number, the time of the cell in s, and what happened; none for some."""
        for text in self._describe(envelope.event):
            yield f"{envelope.sequence:5}  {envelope.cell_time_s:8.1f} s  {text}"

    def _describe(self, event: events.Event) -> Iterator[str]:
        match event:
            case events.NodeStarted(node=node, parent=parent, kind=kind):
                self._start(node, parent, kind == "call")
            case events.NodeEnded(node=node, name=name, status=status, failure=failure):
                if node in self._calls:
                    yield f"{self._indent(self._calls.pop(node))}{name}: {status}{_because(failure)}"
            case events.ImplementationChosen(node=node, skill=skill, implementation=chosen, bindings=bindings):
                values = ", ".join(f"{name}: {format_value(value)}" for name, value in bindings.items())
                yield f"{self._indent(self._calls.get(node, 0))}{skill}[{chosen}]({values})"
            case events.WorldChanged(origin=origin, changes=changes):
                yield from (f"{origin}: {format_change(each)}" for each in changes)
            case _:
                yield from _describe_task(event)

    def _start(self, node: int, parent: int, is_call: bool) -> None:
        depth = self._depths.get(parent, 0)
        self._depths[node] = depth + is_call
        if is_call:
            self._calls[node] = depth

    def _indent(self, depth: int) -> str:
        return "  " * depth


def _describe_task(event: events.Event) -> Iterator[str]:
    match event:
        case events.TaskStarted(task=task, library=library):
            yield f"{task} of {library}" if library else task
        case events.StateChanged(state=state, reason=reason, contact=contact):
            yield ": ".join(filter(None, (state, reason, SENTENCES[contact])))
        case events.Requested(command=command, refused=refused):
            by = f" by {command.who}" if command.who else ""
            yield f"{command.name}{by} is refused: {refused}" if refused else f"{command.name} is requested{by}"
        case events.Disturbed(disturbance=disturbance, who=who):
            yield f"{describe_disturbance(disturbance)}{f' ({who})' if who else ''}"
        case events.PlanArrived(refused=refused, detail=detail) if refused:
            yield f"no plan: {refused}{f'; {detail}' if detail else ''}"
        case events.PlanMade(steps=steps) as plan:
            yield f"plan: {' -> '.join(each.skill for each in steps)} ({plan.summary})"
        case events.PromptsChanged(prompts=prompts):
            yield from (f"asks: {each.text} ({' | '.join(each.choices)})" for each in prompts)
        case events.Replanned(reason=reason, sensed=sensed):
            yield f"{'goes on' if sensed else 'planning again'}: {reason}"
        case events.Note(message=message):
            yield message
        case events.TaskEnded(status=status, verified=verified, failure=failure, false_claims=claims):
            yield f"{format_status(status, verified, claims)}{_because(failure)}"
            yield from map(format_false_claim, claims)
        case _:
            pass


def _because(failure: Failure | None) -> str:
    return f": {describe_failure(failure)}" if failure else ""


def format_change(change: LabelledChange) -> str:
    """Return a change of the world as a clause."""
    match change:
        case IndividualAdded(individual=individual, classes=classes):
            return f"{individual} is added: {', '.join(map(str, classes))}"
        case IndividualRemoved(individual=individual):
            return f"{individual} is removed"
        case _:
            return format_fact(change)
