"""Finds the libraries that a project depends on: in folders, in installed packages, at entry points."""

from __future__ import annotations

import os
from importlib.metadata import entry_points
from importlib.util import find_spec
from pathlib import Path

from skillc.errors import DiagnosticsError
from skillc.services.project.manifest import Dependency, read_manifest
from skillc.services.project.project import MANIFEST, SHIPPED, Project, is_nested_project
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.encoding import decode, read_file
from skillc_dsl.spelling import did_you_mean

GROUP = "skillc.libraries"
"""The group of entry points whose values are the import names of packages with a `skillc.toml`."""


class _NotFound(Exception):
    """A dependency cannot be used; `help` is advice."""

    def __init__(self, message: str, help_: str = "") -> None:
        super().__init__(message)
        self.help = help_


def resolve_dependencies(project: Project) -> Project:
    """Return the project with the libraries that it depends on. DiagnosticsError if one cannot be found or used."""
    return _resolve(project, (project,), {project.name: project.root.resolve()})


def _resolve(project: Project, chain: tuple[Project, ...], roots: dict[str, Path]) -> Project:
    found: list[Project] = []
    problems: list[Diagnostic] = []
    for name, wanted in project.manifest.dependencies.items():
        try:
            opened = _open(name, wanted, project)
            _check(name, opened, chain, roots)
        except _NotFound as error:
            place = project.place_of("dependencies", name)
            problems.append(Diagnostic("unknown-library", place, str(error), error.help))
            continue
        roots[name] = opened.root.resolve()
        found.append(_resolve(opened, (*chain, opened), roots))
    if problems:
        raise DiagnosticsError(problems, {project.source.path: project.source})
    return project._replace(dependencies=tuple(found))


def _check(name: str, opened: Project, chain: tuple[Project, ...], roots: dict[str, Path]) -> None:
    """Raise _NotFound if a library has another name, depends on itself, or another one has its name."""
    if opened.name != name:
        raise _NotFound(f"the library in {opened.root} is called `{opened.name}`", f"write `{opened.name} = ..`")
    if any(each.name == name for each in chain):
        way = " needs ".join((*(each.name for each in chain), name))
        raise _NotFound(f"the dependencies form a circle: {way}", "move what both need into a third library")
    known = roots.get(name)
    if known is not None and known != opened.root.resolve():
        raise _NotFound(f"two libraries are called `{name}`: {known} and {opened.root.resolve()}", "rename one of them")
    if (SHIPPED / name).is_dir():
        raise _NotFound(f"`{name}` is the name of a library that ships with skillc", "rename the library")
    folder = chain[0].root / name
    if folder.is_dir() and any(folder.glob("*.skill")) and not is_nested_project(folder):
        raise _NotFound(f"the folder `{name}` of this project hides the library `{name}`", "rename the folder")


def _open(name: str, wanted: Dependency, project: Project) -> Project:
    """Return the project of a dependency, without its own dependencies."""
    root = _folder(name, wanted, project)
    file = root / MANIFEST
    if not file.is_file():
        raise _NotFound(f"there is no {MANIFEST} in {root}", f'a library needs one with `name = "{name}"`')
    source = decode(str(file), read_file(file))
    outcome = read_manifest(source)
    if outcome.value is None:
        raise DiagnosticsError(outcome.diagnostics, {source.path: source})
    return Project(root, outcome.value, source)


def _folder(name: str, wanted: Dependency, project: Project) -> Path:
    if wanted.path is not None:
        folder = Path(os.path.normpath(project.root / wanted.path))
        if not folder.is_dir():
            raise _NotFound(f"there is no folder {folder}")
        return folder
    if wanted.package is not None:
        return _package_folder(wanted.package)
    assert wanted.entry_point is not None
    points = entry_points(group=GROUP)
    chosen = [each for each in points if each.name == wanted.entry_point]
    if not chosen:
        known = did_you_mean(wanted.entry_point, points.names) or "install the package that has it"
        raise _NotFound(f"no installed package has the entry point `{wanted.entry_point}` of `{GROUP}`", known)
    return _package_folder(chosen[0].value)


def _package_folder(package: str) -> Path:
    """Return the folder of an importable package, without importing it (only the packages that it is in)."""
    try:
        spec = find_spec(package)
    except (ImportError, ValueError):
        spec = None
    folders = list(spec.submodule_search_locations or ()) if spec else []
    if not folders:
        raise _NotFound(f"there is no package `{package}` here", "install it in the environment of skillc")
    return next((Path(each) for each in folders if Path(each, MANIFEST).is_file()), Path(folders[0]))
