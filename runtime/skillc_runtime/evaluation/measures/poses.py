"""Measures the poses that people taught."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from skillc_runtime.evaluation.measures.evidence import RunEvidence
from skillc_runtime.evaluation.measures.work import TeachingWork, Work
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.state.labels.labelling import label
from skillc_runtime.world.state.terms import IS_TAUGHT, TAUGHT_POSE


def measure(evidence: RunEvidence) -> Iterator[Work]:
    """Yield the teaching of each pose, compared with the nearest intended position of a person."""
    state, guidances = evidence.state, evidence.truth.guidances()
    for taught in sorted(state.instances(TAUGHT_POSE)):
        if guidances and state.value(taught, IS_TAUGHT) is True:
            place = pose(state, taught).position
            errors_m = [float(np.linalg.norm(place - each.place)) for each in guidances]
            nearest = int(np.argmin(errors_m))
            forces = guidances[nearest].forces
            yield TeachingWork(
                pose=label(taught, state.vocabulary),
                position_error_m=errors_m[nearest],
                greatest_n=float(forces.max()),
                mean_n=float(forces.mean()),
                duration_share=evidence.duration_share(taught),
            )
