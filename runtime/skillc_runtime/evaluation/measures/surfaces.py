"""Surfaces that were wiped or polished."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from skillc_runtime.devices.ground_truth import Recording
from skillc_runtime.evaluation.measures.evidence import RunEvidence
from skillc_runtime.evaluation.measures.work import PolishingWork, WipingWork, Work
from skillc_runtime.evaluation.report.result import WipingResult
from skillc_runtime.evaluation.report.wiping import Wiping
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.state.data_sheet import number_of
from skillc_runtime.world.state.terms import POLISH_TIME, POLISHABLE_SURFACE

LEAST_SWING_M = 1e-3
"""An overlay that goes less far is none."""


def measure(evidence: RunEvidence) -> Iterator[Work]:
    """Yield the work on each surface along which a pushed tool followed a path."""
    state = evidence.cell.world.snapshot()
    for wiping, how in evidence.wipings:
        yield (
            _polished(evidence, wiping, how) if state.is_a(wiping.surface, POLISHABLE_SURFACE) else WipingWork(how=how)
        )


def _polished(evidence: RunEvidence, wiping: Wiping, how: WipingResult) -> PolishingWork:
    cell = evidence.cell
    asked, gone = swing_amplitudes(cell.ground_truth.recording(wiping.tool).between(wiping.start, wiping.end))
    seconds = number_of(cell.world.snapshot(), wiping.surface, POLISH_TIME)
    swung = asked > LEAST_SWING_M
    return PolishingWork(
        how=how,
        share=cell.camera().rubbed_share(wiping.surface, seconds),
        swing_m=gone if swung else None,
        swing_asked_m=asked if swung else None,
    )


def swing_amplitudes(window: Recording) -> tuple[float, float]:
    """Return the amplitudes in m of the overlay's strongest oscillation: as it was asked for, and as the tool went."""
    overlay = window.reference - window.path
    farthest = overlay[np.linalg.norm(overlay, axis=1).argmax()]
    along = farthest / max(float(np.linalg.norm(farthest)), 1e-12)
    asked, gone = _spectrum(overlay @ along), _spectrum((window.position - window.path) @ along)
    strongest = int(asked.argmax())
    return float(asked[strongest]), float(gone[strongest])


def _spectrum(signal: Array) -> Array:
    """Return the amplitude at each frequency of a signal (n,), its mean and its ends aside."""
    window = np.hanning(len(signal))
    return np.asarray(np.abs(np.fft.rfft((signal - signal.mean()) * window)) * 2 / window.sum(), dtype=np.float64)
