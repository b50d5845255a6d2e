"""What `skillc doctor` looks for."""

from __future__ import annotations

import platform
import re
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, requires, version

from skillc_runtime.planning.fast_downward import installed
from skillc_runtime.simulation.rendering import RenderingError, check_rendering


@dataclass(frozen=True, slots=True)
class Finding:
    """One thing that was looked for; `meaning` says what works, or what to do."""

    name: str
    found: bool
    version: str
    meaning: str
    required: bool = False


def findings() -> list[Finding]:
    """Look for everything that skillc can use."""
    return [
        Finding("python", True, platform.python_version(), platform.platform(), required=True),
        Finding("skillc", True, version("skillc"), "", required=True),
        *(_package(name) for name in _required()),
        _planner(),
        _rendering(),
        _video(),
    ]


def _required() -> list[str]:
    """Return the names of the packages that skillc always needs."""
    needed = [line for line in requires("skillc") or () if "extra ==" not in line]
    return sorted(re.split(r"[^\w.-]", line, maxsplit=1)[0] for line in needed)


def _package(name: str) -> Finding:
    try:
        return Finding(name, True, version(name), "", required=True)
    except PackageNotFoundError:
        return Finding(name, False, "", f"install it: pip install {name}", required=True)


def _planner() -> Finding:
    if installed():
        return Finding("Fast Downward", True, version("up-fast-downward"), "plans are proved optimal")
    return Finding("Fast Downward", False, "", "the built-in A* plans small scenes; pip install 'skillc[planner]'")


def _rendering() -> Finding:
    try:
        return Finding("GL library", True, check_rendering(), "runs are filmed")
    except RenderingError as error:
        return Finding("GL library", False, "", str(error))


def _video() -> Finding:
    try:
        return Finding("av", True, version("av"), "films are written as MP4")
    except PackageNotFoundError:
        return Finding("av", False, "", "films are left out; pip install 'skillc[video]'")
