"""The evidence by which the work of a run is judged."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

from skillc_model.conditions import Literal
from skillc_model.skills import SkillLibrary
from skillc_runtime.devices.ground_truth import GroundTruth
from skillc_runtime.evaluation.metrics.intervals import subtract_intervals, total_s
from skillc_runtime.evaluation.report.choice_listener import ChoiceListener
from skillc_runtime.evaluation.report.result import WipingResult
from skillc_runtime.evaluation.report.wiping import Wiping
from skillc_runtime.recording.events import ImplementationChosen
from skillc_runtime.recording.node_outcome import NodeOutcome
from skillc_runtime.world.state.world_state import WorldState


@dataclass(frozen=True, slots=True)
class RunEvidence:
    """The world model and the truth after a run, its trees with the chosen implementations, and the rated wipings."""

    library: SkillLibrary
    state: WorldState
    truth: GroundTruth
    trees: tuple[NodeOutcome, ...]
    choices: ChoiceListener
    wipings: tuple[tuple[Wiping, WipingResult], ...]

    def duration_share(self, subject: str) -> float | None:
        """Return the time of the last outermost call about an individual, relative to the duration of its skill.

        Pauses are left out.

        None if there is no such call, or its skill declares no constant duration.
        """
        for call in reversed(tuple(_outermost_calls(self.trees, self.choices, subject))):
            literal = self.library.skills[self.choices[call.id].skill].duration
            if isinstance(literal, Literal) and call.started is not None and call.ended is not None:
                taken = subtract_intervals([(call.started, call.ended)], self.choices.pauses)
                return total_s(taken) / float(literal.value)
        return None


def _outermost_calls(
    nodes: Iterable[NodeOutcome], choices: Mapping[int, ImplementationChosen], subject: str
) -> Iterator[NodeOutcome]:
    for node in nodes:
        choice = choices.get(node.id)
        if choice is not None and subject in choice.individuals:
            yield node
        else:
            yield from _outermost_calls(node.children, choices, subject)
