"""Runners of trials that need no simulation, and trials as they might come out of one."""

from __future__ import annotations

import os
import signal
import time
from dataclasses import dataclass
from pathlib import Path

from skillc_runtime.report.result import WipingResult
from skillc_runtime.trials.trial import Trial

KILLED, BROKEN = 3, 4
"""Seeds at which a process dies, and at which something goes wrong in it."""


def wiping(surface: str = "lab:Table-1", **changes: float) -> WipingResult:
    """Return a wiping that meets all targets, but for what is changed."""
    good: dict[str, float | None] = {
        "coverage": 1.0,
        "force_command_n": 10.0,
        "force_mean_n": 10.1,
        "force_rmse_n": 0.4,
        "contact_lost": 0.0,
        "vibration_mm_s": 0.2,
        "tilt_rms_deg": 0.2,
        "first_impact_n": 11.0,
        "tracking_rms_mm": 5.0,
        "lane_dwell_s": None,
    }
    return WipingResult(surface=surface, **{**good, **changes})  # type: ignore[arg-type]


def good(seed: int, *wipings: WipingResult) -> Trial:
    """Return a trial in which all is as it should be, but for the wipings that are given."""
    return Trial(
        seed=seed,
        status="success",
        variation=f"reality {seed}",
        wipings=wipings or (wiping(),),
        coverage=1.0,
        greatest_force_n=20.0,
        force_limit_n=50.0,
        at_rest=True,
        sim_time_s=40.0,
        wall_time_s=4.0,
    )


@dataclass(frozen=True, slots=True)
class Faulty:
    """Dies at one seed, breaks at another, else succeeds."""

    def run(self, seed: int) -> Trial:
        if seed == KILLED:
            os.kill(os.getpid(), signal.SIGKILL)
        if seed == BROKEN:
            raise ArithmeticError("nothing adds up")
        return good(seed)


@dataclass(frozen=True, slots=True)
class Endless:
    """Writes its process's number into a folder and never ends."""

    folder: Path

    def run(self, seed: int) -> Trial:
        (self.folder / str(os.getpid())).touch()
        while True:
            time.sleep(0.1)
