"""Samples all signals of a cell, a row in each tick, and gives the rows to a sink."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeAlias

import numpy as np

from skillc_runtime.devices.backend import Backend
from skillc_runtime.recording.signals.channels import find_channels
from skillc_runtime.recording.signals.signal import CLOCK, Signal, SignalSink

MakeSink: TypeAlias = Callable[[Sequence[Signal]], SignalSink]


class SignalSampler:
    """Samples the signals of a cell; `sample` is to be called in every tick.

    An error of the sink never stops the robot: sampling ends, and `problem` says why.
    """

    def __init__(self, backend: Backend, make_sink: MakeSink) -> None:
        self._clock = backend.clock
        self._channels = tuple(find_channels(backend))
        self.signals = (CLOCK, *(signal for channel in self._channels for signal in channel.signals))
        self._row = np.empty(len(self.signals))
        self._sink = make_sink(self.signals)
        self._last = -np.inf
        self.problem: str | None = None

    def sample(self) -> None:
        """Take one sample, unless the clock stood still since the last one."""
        if self.problem is not None or self._clock.now <= self._last:
            return
        self._last = self._row[0] = self._clock.now
        start = 1
        for channel in self._channels:
            end = start + len(channel.signals)
            self._row[start:end] = channel.read()
            start = end
        try:
            self._sink.write(self._row)
        except OSError as error:
            self.problem = error.strerror or str(error)

    def close(self) -> None:
        """Complete what was written."""
        try:
            self._sink.close()
        except OSError as error:
            self.problem = self.problem or error.strerror or str(error)
