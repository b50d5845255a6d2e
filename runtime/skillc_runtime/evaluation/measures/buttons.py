"""Measures the pressing of buttons."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from skillc_runtime.evaluation.measures.evidence import RunEvidence
from skillc_runtime.evaluation.measures.work import PressingWork, Work
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.state.data_sheet import number_of
from skillc_runtime.world.state.labels.labelling import label
from skillc_runtime.world.state.terms import BUTTON, PRESS_FORCE

HELD_S = 0.1
"""The held force is the greatest mean force over this time."""


def measure(evidence: RunEvidence) -> Iterator[Work]:
    """Yield the pressing of each button on which a force acted."""
    state = evidence.state
    for button in sorted(state.instances(BUTTON)):
        pressing = evidence.truth.pressing(button)
        if len(pressing):
            yield PressingWork(
                button=label(button, state.vocabulary),
                required_n=number_of(state, button, PRESS_FORCE),
                held_n=compute_held_force_n(pressing),
                greatest_n=float(pressing[:, 1].max()),
                duration_share=evidence.duration_share(button),
            )


def compute_held_force_n(pressing: Array) -> float:
    """Return the greatest mean force in N over `HELD_S` while a button was switched; 0 if it never was for so long.

    pressing (n, 3): time in s, force in N, and 1 while it was switched, at every simulation step.
    """
    switched = pressing[pressing[:, 2] > 0]
    if len(switched) < 2:
        return 0.0
    width = round(HELD_S / float(np.diff(switched[:, 0]).min()))
    if len(switched) < width:
        return 0.0
    return float(np.convolve(switched[:, 1], np.ones(width) / width, mode="valid").max())
