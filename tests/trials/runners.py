"""Runners of trials that need no simulation, and trials as they might come out of one."""

from __future__ import annotations

import os
import signal
import time
from dataclasses import dataclass
from pathlib import Path

from skillc_runtime.evaluation.measures.work import (
    InsertingWork,
    PlacingWork,
    PolishingWork,
    PressingWork,
    TeachingWork,
    WipingWork,
    Work,
)
from skillc_runtime.evaluation.report.result import WipingResult
from skillc_runtime.evaluation.trials.settings import Setting
from skillc_runtime.evaluation.trials.trial import Trial
from skillc_runtime.world.state.labels.labelled import LabelledIri

KILLED, BROKEN = 3, 4
"""Seeds at which a process dies, and at which something goes wrong in it."""


def lab(name: str) -> LabelledIri:
    """Return an individual with its name."""
    return LabelledIri(name.replace("lab:", "http://example.org/lab#"), name)


def wiping(surface: str = "lab:Table-1", **changes: float) -> WipingWork:
    """Return a wiping that meets all targets, but for what is changed."""
    return WipingWork(wiping=wiped(surface, **changes))


def wiped(surface: str, **changes: float) -> WipingResult:
    """Return what is measured of such a wiping."""
    good: dict[str, float | None] = {
        "start_s": 2.0,
        "end_s": 30.0,
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
    return WipingResult(surface=lab(surface), **{**good, **changes})  # type: ignore[arg-type]


GOOD: dict[str, Work] = {
    "wiping": wiping(),
    "polishing": PolishingWork(
        wiping=wiped("lab:Sheet-1"), polished_share=1.0, overlay_amplitude_m=0.0095, commanded_amplitude_m=0.01
    ),
    "pressing": PressingWork(
        button=lab("lab:Button-1"), required_n=10.0, held_n=10.0, greatest_n=10.5, duration_share=0.9
    ),
    "inserting": InsertingWork(
        socket=lab("lab:Socket-1"), depth_m=0.03, hole_depth_m=0.03, greatest_n=20.0, duration_share=0.5
    ),
    "teaching": TeachingWork(
        pose=lab("lab:TeachingWork-1"), position_error_m=0.001, greatest_n=18.0, mean_n=5.0, duration_share=0.4
    ),
    "placing": PlacingWork(thing=lab("lab:Part-1"), error_m=0.002, turned_deg=1.0, missed_m=0.003),
}
"""A piece of work of each kind that meets all targets."""


def good(seed: int, *works: Work) -> Trial:
    """Return a trial in which all is as it should be, but for the works that are given."""
    return Trial(
        seed=seed,
        status="succeeded",
        variation=f"reality {seed}",
        works=works or (wiping(),),
        coverage=1.0,
        greatest_force_n=20.0,
        force_limit_n=50.0,
        pushed=True,
        at_rest=True,
        sim_time_s=40.0,
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


class Exits:
    """Ends its process when it is made, as code does that calls os._exit while it is imported."""

    def __init__(self, *_experiment: object) -> None:
        os._exit(5)

    def run(self, seed: int) -> Trial:
        return good(seed)


class Vanishes:
    """Its process is killed when it is made."""

    def __init__(self) -> None:
        os.kill(os.getpid(), signal.SIGKILL)

    def run(self, seed: int) -> Trial:
        return good(seed)


class Unprepared:
    """Cannot be made."""

    def __init__(self) -> None:
        raise FileNotFoundError("there is no scene")

    def run(self, seed: int) -> Trial:
        return good(seed)


class Waits:
    """Takes a time to be made."""

    def __init__(self, seconds: float) -> None:
        time.sleep(seconds)

    def run(self, seed: int) -> Trial:
        return good(seed)


class FailsOnce:
    """Ends its process when it is made for the first time; a folder counts how often it was made."""

    def __init__(self, folder: Path) -> None:
        try:
            (folder / "made").touch(exist_ok=False)
        except FileExistsError:
            (folder / str(os.getpid())).touch()
        else:
            os._exit(1)

    def run(self, seed: int) -> Trial:
        return good(seed)


@dataclass(frozen=True, slots=True)
class Slow:
    """Never ends at one seed."""

    folder: Path

    def run(self, seed: int) -> Trial:
        if seed == BROKEN - 2:
            Endless(self.folder).run(seed)
        return good(seed)


@dataclass(frozen=True, slots=True)
class Noted:
    """Notes in a folder the process of each trial and its parent, and takes a time; dies at one seed."""

    folder: Path
    seconds: float

    def run(self, seed: int) -> Trial:
        (self.folder / f"{seed}-{os.getpid()}-{os.getppid()}").touch()
        if seed == KILLED:
            os.kill(os.getpid(), signal.SIGKILL)
        time.sleep(self.seconds)
        return good(seed)


@dataclass(frozen=True, slots=True)
class Echoing:
    """Says with which settings it was run."""

    def run(self, seed: int, *settings: Setting) -> Trial:
        said = "; ".join(f"{each.parameter} of {each.implementation} is {each.value}" for each in settings)
        return Trial(seed=seed, status="failed", reason=said)
