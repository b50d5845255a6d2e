"""What a display shows of a run: its state and its active calls, as the run has them or as its events say."""

from __future__ import annotations

from dataclasses import dataclass, field

import msgspec

from skillc.contract.operation import OperationStatus
from skillc_dsl.position import Position
from skillc_runtime.devices.prompts import Prompt
from skillc_runtime.execution.task_run import TaskRun
from skillc_runtime.execution.tree.gate import GatedCall
from skillc_runtime.planning.progress import PlanningProgress, describe_progress
from skillc_runtime.recording.contact import ContactState
from skillc_runtime.recording.events import (
    Event,
    ImplementationChosen,
    NodeEnded,
    NodeStarted,
    PromptsChanged,
    Replanned,
)
from skillc_runtime.recording.states import State


class ShownCall(msgspec.Struct, frozen=True):
    """A call of a skill, with its place."""

    skill: str
    source: Position


class CallStack(msgspec.Struct, frozen=True):
    """An active call and those around it, the innermost first; it is `next` if it has not started."""

    calls: tuple[ShownCall, ...]
    next: bool = False


class RunView(msgspec.Struct, frozen=True):
    """A run at one moment; `contact` is what becomes of a tool that pressed when it was paused.

    `confirms`: the user confirms each step.
    """

    state: State
    reason: str
    allowed: tuple[str, ...]
    stacks: tuple[CallStack, ...] = ()
    contact: ContactState = "none"
    prompts: tuple[Prompt, ...] = ()
    confirms: bool = False


def view_run(run: TaskRun) -> RunView:
    """Return what there is to show of a run of this process."""
    tree, allowed, confirms = run.tree, tuple(run.allowed), run.spec.confirm_steps
    if tree is None:
        return RunView(run.state, _join_reason(run.reason, run.planning), allowed, confirms=confirms)
    stacks = tuple(CallStack(_stack(each), tree.holds_back(each)) for each in tree.active_calls)
    return RunView(run.state, run.reason, allowed, stacks, run.contact, run.prompts, confirms)


@dataclass(slots=True)
class EventView:
    """What there is to show of a run elsewhere, after its events."""

    _nodes: dict[int, NodeStarted] = field(default_factory=dict)
    _chosen: set[int] = field(default_factory=set)
    _prompts: tuple[Prompt, ...] = ()

    def observe(self, event: Event) -> None:
        """Take an event into account."""
        match event:
            case NodeStarted(node=node):
                self._nodes[node] = event
            case ImplementationChosen(node=node):
                self._chosen.add(node)
            case NodeEnded(node=node):
                self._nodes.pop(node, None)
                self._chosen.discard(node)
            case PromptsChanged(prompts=prompts):
                self._prompts = prompts
            case Replanned():
                self._nodes.clear()
                self._chosen.clear()
            case _:
                pass

    def view(self, status: OperationStatus) -> RunView:
        """Return what there is to show, with the state of its operation."""
        reason = _join_reason(status.reason, status.planning)
        confirms = status.request.confirm_steps
        return RunView(status.state, reason, status.allowed, self.stacks, status.contact, self._prompts, confirms)

    @property
    def stacks(self) -> tuple[CallStack, ...]:
        """The active calls with those around them."""
        return tuple(
            CallStack(self._find_stack(each), each.node not in self._chosen) for each in self._find_innermost()
        )

    def _find_innermost(self) -> list[NodeStarted]:
        """Return the active calls that no other active call is in."""
        calls = [each for each in self._nodes.values() if each.kind == "call"]
        around = {outer.node for each in calls for outer in self._find_enclosing(each)}
        return [each for each in calls if each.node not in around]

    def _find_stack(self, call: NodeStarted) -> tuple[ShownCall, ...]:
        return tuple(ShownCall(each.name, each.source) for each in (call, *self._find_enclosing(call)))

    def _find_enclosing(self, call: NodeStarted) -> list[NodeStarted]:
        found, node = list[NodeStarted](), self._nodes.get(call.parent)
        while node is not None:
            found += [node] if node.kind == "call" else []
            node = self._nodes.get(node.parent)
        return found


def _join_reason(reason: str, planning: PlanningProgress | None) -> str:
    return ": ".join(filter(None, (reason, "" if planning is None else describe_progress(planning))))


def _stack(call: GatedCall) -> tuple[ShownCall, ...]:
    return tuple(ShownCall(each.skill_name, each.source) for each in (call, *call.enclosing_calls()))
