"""Measures the wiping and polishing of surfaces."""

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

MIN_AMPLITUDE_M = 1e-3
"""A path with a smaller overlay counts as one without."""


def measure(evidence: RunEvidence) -> Iterator[Work]:
    """Yield the work on each surface along which a pressed tool followed a path."""
    for wiping, result in evidence.wipings:
        yield (
            _measure_polishing(evidence, wiping, result)
            if evidence.state.is_a(wiping.surface, POLISHABLE_SURFACE)
            else WipingWork(wiping=result)
        )


def _measure_polishing(evidence: RunEvidence, wiping: Wiping, result: WipingResult) -> PolishingWork:
    truth = evidence.truth
    window = truth.recording(wiping.tool).between(*wiping.longest_undisturbed)
    commanded, measured = measure_overlay_amplitudes(window)
    seconds = number_of(evidence.state, wiping.surface, POLISH_TIME)
    oscillated = commanded > MIN_AMPLITUDE_M
    return PolishingWork(
        wiping=result,
        polished_share=truth.coverage(wiping.surface).rubbed_share(seconds),
        overlay_amplitude_m=measured if oscillated else None,
        commanded_amplitude_m=commanded if oscillated else None,
    )


def measure_overlay_amplitudes(window: Recording) -> tuple[float, float]:
    """Return the commanded and the measured amplitude of the overlay's strongest oscillation, in m."""
    overlay = window.reference - window.path
    farthest = overlay[np.linalg.norm(overlay, axis=1).argmax()]
    along = farthest / max(float(np.linalg.norm(farthest)), 1e-12)
    commanded, measured = _spectrum(overlay @ along), _spectrum((window.position - window.path) @ along)
    strongest = int(commanded.argmax())
    return float(commanded[strongest]), float(measured[strongest])


def _spectrum(signal: Array) -> Array:
    """Return the amplitude at each frequency of a signal (n,), without its mean, with a Hann window."""
    window = np.hanning(len(signal))
    return np.asarray(np.abs(np.fft.rfft((signal - signal.mean()) * window)) * 2 / window.sum(), dtype=np.float64)
