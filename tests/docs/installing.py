"""Installs a package of a page in a folder, without a network: what `pip install .` leaves there."""

from __future__ import annotations

import os
import shutil
import tomllib
from pathlib import Path

import pytest


def install(project: Path, site: Path) -> None:
    """Do what `pip install` does with a project of modules: copy them, and write down its name and entry points."""
    read = tomllib.loads((project / "pyproject.toml").read_text("utf-8"))
    about, modules = read["project"], read["tool"]["setuptools"]["py-modules"]
    information = site / f"{about['name'].replace('-', '_')}-{about['version']}.dist-info"
    information.mkdir(parents=True)
    metadata = f"Metadata-Version: 2.1\nName: {about['name']}\nVersion: {about['version']}\n"
    (information / "METADATA").write_text(metadata, "utf-8")
    groups = about["entry-points"].items()
    points = "".join(f"[{group}]\n" + "".join(f"{n} = {v}\n" for n, v in them.items()) for group, them in groups)
    (information / "entry_points.txt").write_text(points, "utf-8")
    for module in modules:
        shutil.copy(project / f"{module}.py", site)


def use(site: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let this process and those that it starts find what is installed in a folder."""
    monkeypatch.syspath_prepend(str(site))
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(filter(None, (str(site), os.environ.get("PYTHONPATH")))))
