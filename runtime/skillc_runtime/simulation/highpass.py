"""A high-pass without phase: Butterworth of 4th order, forward and backward."""

from __future__ import annotations

import numpy as np

from skillc_runtime.motion.pose import Array

ORDER = 4


def highpass(signal: Array, cutoff_hz: float, step_s: float) -> Array:
    """Return the columns of `signal` (n, k) without what is slower than the cutoff.

    Running the digital Butterworth filter (bilinear transform) forward and backward multiplies the spectrum by
    |H|^2 = 1 / (1 + (tan(pi fc h) / tan(pi f h))^2N). The signal is continued antisymmetrically at both ends.
    """
    margin = min(len(signal) - 1, int(3 / (cutoff_hz * step_s)))
    head, tail = 2 * signal[0] - signal[margin:0:-1], 2 * signal[-1] - signal[-2 : -margin - 2 : -1]
    padded = np.concatenate([head, signal, tail])
    spectrum = np.fft.rfft(padded, axis=0)
    half_angle = np.pi * np.fft.rfftfreq(len(padded), step_s) * step_s
    gain = np.zeros_like(half_angle)
    gain[1:] = 1 / (1 + (np.tan(np.pi * cutoff_hz * step_s) / np.tan(half_angle[1:])) ** (2 * ORDER))
    filtered = np.fft.irfft(spectrum * gain[:, None], len(padded), axis=0)
    return np.asarray(filtered[margin : margin + len(signal)])
