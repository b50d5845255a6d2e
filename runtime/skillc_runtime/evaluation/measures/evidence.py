"""What there is to judge a run by."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

from skillc_model.conditions import Literal
from skillc_model.skills import SkillLibrary
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.evaluation.report.result import WipingResult
from skillc_runtime.evaluation.report.wiping import Wiping
from skillc_runtime.recording.events import ImplementationChosen
from skillc_runtime.recording.node_outcome import NodeOutcome


@dataclass(frozen=True, slots=True)
class RunEvidence:
    """The cell that a run left behind, its trees with the choices made in them, and the wiping that was found there."""

    library: SkillLibrary
    cell: SimulatedCell
    trees: tuple[NodeOutcome, ...]
    choices: Mapping[int, ImplementationChosen]
    wipings: tuple[tuple[Wiping, WipingResult], ...]

    def duration_share(self, subject: str) -> float | None:
        """Return how long the last of the outermost calls about an individual took, as a share of what its skill says.

        None where there is none, or its skill says nothing.
        """
        for call in reversed(tuple(_outermost(self.trees, self.choices, subject))):
            literal = self.library.skills[self.choices[call.id].skill].duration
            if isinstance(literal, Literal) and call.started is not None and call.ended is not None:
                return (call.ended - call.started) / float(literal.value)
        return None


def _outermost(
    nodes: Iterable[NodeOutcome], choices: Mapping[int, ImplementationChosen], subject: str
) -> Iterator[NodeOutcome]:
    for node in nodes:
        choice = choices.get(node.id)
        if choice is not None and subject in choice.individuals:
            yield node
        else:
            yield from _outermost(node.children, choices, subject)
