"""Finds which of the programs and packages that skillc can use are installed."""

from __future__ import annotations

import platform
import re
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, requires, version

from skillc.extras import install_command, missing_extras
from skillc_runtime.planning.cp_sat.solver import find_cp_sat
from skillc_runtime.planning.fast_downward import solver as fast_downward

_OTHERS = {
    "run": ("av", "films are written as MP4"),
    "robots": ("pin", "models of robots are read"),
    "server": ("starlette", "cells are served"),
    "meshes": ("coacd", "meshes are cut into convex pieces"),
    "data": ("pyarrow", "signals are written as Parquet"),
    "vision": ("opencv-python-headless", "images are inspected"),
}
"""A package of each of the other extras, and what works with it."""


@dataclass(frozen=True, slots=True)
class Finding:
    """A program or package; `meaning` says what works with it or, if it is missing, how to install it."""

    name: str
    found: bool
    version: str
    meaning: str
    required: bool = False


def diagnose_environment() -> list[Finding]:
    """Return a finding for each program and package that skillc can use."""
    return [
        Finding("python", True, platform.python_version(), platform.platform(), required=True),
        Finding("skillc", True, version("skillc"), "", required=True),
        *(_package(name) for name in _required()),
        *_planners(),
        *_simulation(),
        *_others(),
    ]


def _required() -> list[str]:
    """Return the names of the packages that skillc requires."""
    needed = [line for line in requires("skillc") or () if "extra ==" not in line]
    return sorted(re.split(r"[^\w.-]", line, maxsplit=1)[0] for line in needed)


def _package(name: str) -> Finding:
    try:
        return Finding(name, True, version(name), "", required=True)
    except PackageNotFoundError:
        return Finding(name, False, "", f"install it: pip install {name}", required=True)


def _planners() -> Iterator[Finding]:
    if fast_downward.find_fast_downward():
        can = "plans with proved minimal work"
        yield Finding("Fast Downward", True, version("up-fast-downward"), can)
    else:
        yield Finding("Fast Downward", False, "", f"plans for larger scenes; {install_command('planner')}")
    yield Finding("built-in A*", True, version("skillc"), "plans for small scenes, with proved minimal work")
    if find_cp_sat():
        yield Finding("CP-SAT", True, version("ortools"), "schedules with a short makespan (--minimise makespan)")
    else:
        missing = f"schedules with a shorter makespan; {install_command('temporal')}"
        yield Finding("CP-SAT", False, "", missing)


def _simulation() -> Iterator[Finding]:
    if missing_extras("run"):
        yield Finding("simulation", False, "", f"runs tasks and looks at space in checks; {install_command('run')}")
        return
    yield Finding("simulation", True, version("mujoco"), "tasks are run, and checks look at space")
    from skillc_runtime.film.rendering import RenderingError, check_rendering

    try:
        yield Finding("GL library", True, check_rendering(), "runs are filmed")
    except RenderingError as error:
        yield Finding("GL library", False, "", str(error))


def _others() -> Iterator[Finding]:
    for extra, (package, can) in _OTHERS.items():
        try:
            yield Finding(package, True, version(package), can)
        except PackageNotFoundError:
            yield Finding(package, False, "", f"{can}; {install_command(extra)}")
