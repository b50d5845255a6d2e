"""A task that needs no simulation: what is measured of it is a function of its settings and of the world."""

from __future__ import annotations

import os
import signal
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from skillc.services.learning.expressions import read_expressions
from skillc.services.learning.figures import Figures
from skillc.services.learning.parameters import Learnable
from skillc.services.learning.racing import Aim
from skillc.services.learning.study import Basis, Study, StudySetup
from skillc_runtime.evaluation.trials.settings import Setting
from skillc_runtime.evaluation.trials.trial import Trial
from trials.runners import good, wiping

UNITS = {"simulated_time": ("s",), "force_rmse": ("% of F",), "coverage": ("%",)}


def parameter(name: str, low: float, high: float, default: float, unit: str = "", kind: str = "Number") -> Learnable:
    """Return a parameter of the implementation `Wipe.wipe_lanes`."""
    return Learnable(
        implementation="Wipe.wipe_lanes",
        parameter=name,
        low=low,
        high=high,
        default=default,
        unit=unit,
        type=kind,
        path="wipe.skill",
    )


SPEED, RADIUS = parameter("speed", 0.01, 0.3, 0.1, "m/s", "Speed"), parameter("radius", 0.0, 50.0, 15.0, "mm", "Length")
BASIS = Basis(learnable=(SPEED, RADIUS), units=UNITS)


def aim(minimise: str, subject_to: str = "") -> Aim:
    """Return what is wanted of the task."""
    return Aim(*read_expressions(minimise, subject_to, Figures({name: frozenset(u) for name, u in UNITS.items()})))


def open_study(folder: Path, objectives: int, minimise: str = "time", seed: int = 0) -> Study:
    """Return the study of a folder, which is begun if it is not there."""
    heading = StudySetup(
        task="wipe",
        skillc="1",
        library="a",
        scene="b",
        minimise=minimise,
        subject_to="",
        parameters="",
        trials=3,
        seed=seed,
    )
    study = Study(folder, heading)
    if study.basis is None:
        study.create(BASIS, objectives)
    return study


@dataclass(frozen=True, slots=True)
class Wiping:
    """Wiping that takes less time when it is fast, has a force error that grows with the radius, and may miss places.

    Each trial is noted in a folder, if there is one; its process dies at one seed of fast candidates.
    """

    folder: Path | None = None
    deadly: int = -1

    def run(self, seed: int, *settings: Setting) -> Trial:
        values: Mapping[str, float] = {each.parameter: each.value for each in settings}
        speed, radius = values["speed"], values["radius"]
        if self.folder is not None:
            with (self.folder / "noted").open("a") as notes:
                notes.write(f"{seed} {speed} {radius}\n")
        if seed == self.deadly and speed > 0.1:
            os.kill(os.getpid(), signal.SIGKILL)
        trial = good(
            seed,
            wiping(
                force_rmse_n=0.2 + 10.0 * (speed - 0.06) ** 2 + 10.0 * radius + 0.01 * (seed % 3),
                coverage=1.0 if radius < 0.03 else 0.99,
            ),
        )
        return Trial(
            **{**{name: getattr(trial, name) for name in trial.__struct_fields__}, "sim_time_s": 2.0 / speed + seed}
        )
