"""A project: a folder with a `skillc.toml`, and the libraries that it depends on."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import skillc_skills
from skillc_dsl.source import Source

if TYPE_CHECKING:
    from skillc.services.project.manifest import Manifest
    from skillc_dsl.source import Span

MANIFEST = "skillc.toml"
DEFAULT_BACKEND = "mujoco"
"""The back end of runs, of trials, and of the twins of cells that cannot be built again."""
SYMBOLIC = "symbolic"
"""The back end without bodies: in its cells skills act as they declare, and scenes need no poses, sizes or sheets."""
VIRTUAL_ENVIRONMENT = "pyvenv.cfg"
SHIPPED = Path(skillc_skills.__path__[0])


class Project(NamedTuple):
    """A library with a manifest. `root` is its folder, `source` the manifest's text with a displayable path."""

    root: Path
    manifest: Manifest
    source: Source
    dependencies: tuple[Project, ...] = ()

    @property
    def name(self) -> str:
        """The name of the library."""
        return self.manifest.name

    @property
    def namespace(self) -> str:
        """The namespace of the terms that the library declares."""
        from skillc_compiler.resolve.files import library_namespace

        return self.manifest.namespace or library_namespace(self.name)

    @property
    def ontologies(self) -> tuple[Path, ...]:
        """The ontology folders of the project itself."""
        return tuple(self.root / folder for folder in self.manifest.ontology)

    def others(self) -> tuple[Project, ...]:
        """Return all libraries that the project depends on, directly or not, each once."""
        found = {each.name: each for each in self._below()}
        return tuple(found[name] for name in sorted(found))

    def place_of(self, *keys: str) -> Span:
        """Return the place of a key in the manifest."""
        from skillc.services.project.toml_places import TomlPlaces

        return TomlPlaces(self.source).find(keys)

    def _below(self) -> Iterator[Project]:
        for each in self.dependencies:
            yield each
            yield from each._below()


def find_root(path: Path) -> Path | None:
    """Return the folder of the project that a path is in, None if it is in none.

    The search goes upward and ends at the root of a virtual environment; a shipped library is in no project.
    """
    start = path.resolve()
    if start.is_relative_to(SHIPPED.resolve()):
        return None
    for folder in (start, *start.parents):
        if (folder / MANIFEST).is_file():
            return folder
        if (folder / VIRTUAL_ENVIRONMENT).is_file():
            return None
    return None


def is_nested_project(folder: Path) -> bool:
    """Whether a folder below a project does not belong to it: another project, or a virtual environment."""
    return (folder / MANIFEST).is_file() or (folder / VIRTUAL_ENVIRONMENT).is_file()
