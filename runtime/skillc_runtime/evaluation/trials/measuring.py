"""Everything that was worked on in a run, measured."""

from __future__ import annotations

from skillc_runtime.evaluation.measures import buttons, holes, poses, surfaces
from skillc_runtime.evaluation.measures.evidence import Evidence
from skillc_runtime.evaluation.trials.work import Work

MEASURES = (surfaces.measure, buttons.measure, holes.measure, poses.measure)
"""In the order in which trials tell of them."""


def works(evidence: Evidence) -> tuple[Work, ...]:
    """Return all work that is found in a run."""
    return tuple(work for measure in MEASURES for work in measure(evidence))
