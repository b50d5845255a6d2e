"""Surfaces that were wiped or polished."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from skillc_runtime.motion.pose import Array
from skillc_runtime.report.result import WipingResult
from skillc_runtime.report.wiping import Wiping
from skillc_runtime.simulation.recorder import Recording
from skillc_runtime.trials.measures.evidence import Evidence
from skillc_runtime.trials.work import Polished, Wiped, Work
from skillc_runtime.world.state.data_sheet import number
from skillc_runtime.world.state.terms import POLISH_TIME, POLISHABLE_SURFACE

LEAST_SWING_M = 1e-3
"""An overlay that goes less far is none."""


def measure(evidence: Evidence) -> Iterator[Work]:
    """Yield the work on each surface along which a pushed tool followed a path."""
    state = evidence.cell.world.snapshot()
    for wiping, how in evidence.wipings:
        yield _polished(evidence, wiping, how) if state.is_a(wiping.surface, POLISHABLE_SURFACE) else Wiped(how=how)


def _polished(evidence: Evidence, wiping: Wiping, how: WipingResult) -> Polished:
    cell = evidence.cell
    asked, gone = swing(cell.recording(wiping.tool).between(wiping.start, wiping.end))
    seconds = number(cell.world.snapshot(), wiping.surface, POLISH_TIME)
    swung = asked > LEAST_SWING_M
    return Polished(
        how=how,
        share=cell.camera().rubbed(wiping.surface, seconds),
        swing_m=gone if swung else None,
        swing_asked_m=asked if swung else None,
    )


def swing(window: Recording) -> tuple[float, float]:
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
