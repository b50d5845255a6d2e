"""Identifies what trials depend on besides task, library and scene: the code and data of skillc, and the simulator."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator
from functools import cache
from importlib import import_module
from importlib.metadata import version
from pathlib import Path

PACKAGES = ("skillc_runtime", "skillc_ontology")
SUFFIXES = (".py", ".ttl", ".xml")
DIGITS = 12


@cache
def identify_skillc() -> str:
    """Return the version of skillc, a digest of its code and data for execution, and the version of MuJoCo."""
    return f"{version('skillc')} of {compute_digest(_read_files())}, MuJoCo {version('mujoco')}"


def compute_digest(contents: Iterable[bytes]) -> str:
    """Return a short digest of contents in order."""
    sha = hashlib.sha256()
    for content in contents:
        sha.update(b"%d:" % len(content) + content)
    return sha.hexdigest()[:DIGITS]


def _read_files() -> Iterator[bytes]:
    for package in PACKAGES:
        folder = Path(import_module(package).__path__[0])
        for file in sorted(file for file in folder.rglob("*") if file.suffix in SUFFIXES):
            yield str(file.relative_to(folder)).encode()
            yield file.read_bytes()
