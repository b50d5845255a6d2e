"""What trials depend on besides task, library and scene: this skillc with its data, and the physics beneath."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from functools import cache
from importlib import import_module
from importlib.metadata import version
from pathlib import Path

PACKAGES = ("skillc_runtime", "skillc_ontology")
KINDS = (".py", ".ttl", ".xml")
DIGITS = 12


@cache
def skillc_identity() -> str:
    """Return the version of skillc, a digest of what runs and simulates in it, and the version of MuJoCo."""
    return f"{version('skillc')} of {digest(_contents())}, MuJoCo {version('mujoco')}"


def digest(contents: Iterator[bytes]) -> str:
    """Return a short digest of some contents in their order."""
    sha = hashlib.sha256()
    for content in contents:
        sha.update(b"%d:" % len(content) + content)
    return sha.hexdigest()[:DIGITS]


def file_identity(path: Path) -> str:
    """Return the name and a digest of a file; OSError where it cannot be read."""
    return f"{path.name} of {digest(iter((path.read_bytes(),)))}"


def _contents() -> Iterator[bytes]:
    for package in PACKAGES:
        folder = Path(import_module(package).__path__[0])
        for file in sorted(file for file in folder.rglob("*") if file.suffix in KINDS):
            yield str(file.relative_to(folder)).encode()
            yield file.read_bytes()
