"""Runs Python as if only what `pip install skillc` brings were installed: everything else that is here is hidden."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tomllib
from functools import cache
from importlib.metadata import PackageNotFoundError, packages_distributions, requires
from pathlib import Path

from skillc.extras import MODULES

ROOT = Path(__file__).parents[2]
HIDE = """
import sys

class Hidden:
    def __init__(self, finder):
        self.finder = finder

    def __getattr__(self, name):
        return getattr(self.finder, name)

    def find_spec(self, name, path=None, target=None):
        return None if name.partition(".")[0] in NAMES else self.finder.find_spec(name, path, target)

sys.meta_path[:] = [Hidden(each) for each in sys.meta_path]
"""


def call(folder: Path, *arguments: str | Path, given: str = "") -> subprocess.CompletedProcess[str]:
    """Run Python with arguments in a folder, where a `site` folder hides what is not of the base."""
    site = folder / ".site"
    site.mkdir(exist_ok=True)
    (site / "sitecustomize.py").write_text(f"NAMES = {sorted(hidden_modules())!r}\n{HIDE}", "utf-8")
    path = os.pathsep.join((str(site), *(each for each in sys.path if each)))
    return subprocess.run(
        [sys.executable, *map(str, arguments)],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": path, "SKILLC_CACHE": str(folder / ".cache")},
        capture_output=True,
        text=True,
        check=False,
        input=given,
        timeout=300,
    )


@cache
def hidden_modules() -> frozenset[str]:
    """Return the modules of extras, and of all installed packages but those of the base and what these need."""
    kept = _closure(tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]["dependencies"])
    modules = {name: {_normal(each) for each in owners} for name, owners in packages_distributions().items()}
    hidden = {name for name, owners in modules.items() if owners.isdisjoint(kept) and not name.startswith("_")}
    return frozenset(each for each in hidden if not each.startswith("skillc")).union(*MODULES.values())


def _closure(lines: list[str]) -> set[str]:
    """Return the names of the packages that requirements name, and of those that they need without extras."""
    kept, waiting = set[str](), [*lines]
    while waiting:
        line = waiting.pop()
        name = _normal(re.split(r"[^\w.-]", line, maxsplit=1)[0])
        if name in kept or "extra ==" in line:
            continue
        kept.add(name)
        try:
            waiting += requires(name) or ()
        except PackageNotFoundError:
            continue
    return kept


def _normal(name: str) -> str:
    return re.sub(r"[-_.]+", "-", name).lower()
