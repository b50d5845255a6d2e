"""Poses that people taught."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from skillc_runtime.evaluation.measures.evidence import RunEvidence
from skillc_runtime.evaluation.measures.work import TeachingWork, Work
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.state.terms import IS_TAUGHT, TAUGHT_POSE


def measure(evidence: RunEvidence) -> Iterator[Work]:
    """Yield each pose that was taught, with the person who wanted it nearest to there."""
    cell, state = evidence.cell, evidence.cell.world.snapshot()
    leaders = [person for person in cell.people if person.forces]
    for taught in sorted(state.instances(TAUGHT_POSE)):
        if leaders and state.value(taught, IS_TAUGHT) is True:
            place = pose(state, taught).position
            off = [float(np.linalg.norm(place - person.place)) for person in leaders]
            nearest = int(np.argmin(off))
            forces = np.array(leaders[nearest].forces)
            yield TeachingWork(
                pose=cell.scene.names[taught],
                off_m=off[nearest],
                greatest_n=float(forces.max()),
                mean_n=float(forces.mean()),
                took=evidence.duration_share(taught),
            )
