"""The lock file `skillc.lock`: the versions and hashes of the libraries that a project depends on."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterator
from pathlib import Path

import msgspec

from skillc.errors import ServiceError
from skillc.services.project.project import Project, is_nested_project
from skillc.services.project.toml_text import load_toml
from skillc_dsl.diagnostics import Diagnostic
from skillc_ontology import catalogue

LOCK = "skillc.lock"
_HEAD = "# Written by `skillc lock`; `skillc check` compares it with the libraries that are used. Commit this file.\n"
_ENDINGS = (
    ".skill",
    *catalogue.ENDINGS,
    ".urdf",
    ".py",
    ".toml",
    ".obj",
    ".stl",
)
_HELP = "run `skillc lock` if the change is meant"


class LockedLibrary(msgspec.Struct, frozen=True):
    """A library as it was locked: its version and the hash of its files."""

    version: str
    sha256: str


def write_lock(project: Project) -> Path:
    """Write the lock file of a project and return its path. ServiceError if it cannot be written."""
    path = project.root / LOCK
    entries = [_HEAD]
    for name, each in lock_libraries(project).items():
        entries.append(f"\n[{name}]\nversion = {json.dumps(each.version)}\nsha256 = {json.dumps(each.sha256)}\n")
    try:
        path.write_text("".join(entries), encoding="utf-8")
    except OSError as error:
        raise ServiceError(f"{path} cannot be written: {error.strerror}") from error
    return path


def lock_libraries(project: Project) -> dict[str, LockedLibrary]:
    """Return the current versions and hashes of all libraries that a project depends on, by name."""
    return {each.name: LockedLibrary(each.manifest.version, hash_library(each.root)) for each in project.others()}


def check_lock(project: Project) -> Iterator[Diagnostic]:
    """Yield a diagnostic for each library that is not as it was locked; none if there is no lock file."""
    path = project.root / LOCK
    if not path.is_file():
        return
    try:
        locked = msgspec.convert(load_toml(path.read_text("utf-8")), dict[str, LockedLibrary])
    except (OSError, ValueError) as error:
        message = f"{LOCK} cannot be read: {error}"
        yield Diagnostic("outdated-lock", project.place_of("dependencies"), message, "run `skillc lock`")
        return
    used = lock_libraries(project)
    for name in sorted({*locked, *used}):
        message = _difference(name, locked.get(name), used.get(name))
        if message:
            yield Diagnostic("outdated-lock", project.place_of("dependencies", name), message, _HELP)


def hash_library(root: Path) -> str:
    """Return the SHA-256 of the skills, ontologies, models and Python code below a library's folder."""
    digest = hashlib.sha256()
    for file in sorted(_files(root)):
        content = file.read_bytes()
        digest.update(f"{file.relative_to(root).as_posix()}\0{len(content)}\0".encode())
        digest.update(content)
    return digest.hexdigest()


def _difference(name: str, locked: LockedLibrary | None, used: LockedLibrary | None) -> str:
    if used is None:
        return f"{LOCK} has `{name}`, which is no dependency"
    if locked is None:
        return f"`{name}` is not in {LOCK}"
    if locked.version != used.version:
        return f"`{name}` has version {used.version}, and {LOCK} has {locked.version}"
    return f"`{name}` was changed since it was locked, in its version {used.version}" if locked != used else ""


def _files(root: Path) -> Iterator[Path]:
    for place, folders, names in os.walk(root):
        folders[:] = [
            each
            for each in folders
            if not each.startswith(".") and each != "__pycache__" and not is_nested_project(Path(place, each))
        ]
        yield from (Path(place, name) for name in names if name.endswith(_ENDINGS))
