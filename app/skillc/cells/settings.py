"""What a cell is started with."""

from __future__ import annotations

from pathlib import Path

import msgspec

from skillc.services.project.backends import BackendName

JOURNAL, WORLD = "journal.sqlite", "world"
"""The files of a cell in its folder."""


class CellSettings(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """A cell named `name` with the scene and the library in these files, which keeps its state in a folder.

    `seed` determines how the reality of a simulation differs from the scene. `content` is the compiled library, empty
    to read it from its files; `modules` are those of Python that texts may name, `environment` are the variables of
    its process. `ended` is why the process before has ended, empty if that is not known.
    """

    name: str
    scene: str
    library: str
    folder: str
    backend: BackendName = "mujoco"
    seed: int = 0
    content: bytes = b""
    modules: tuple[str, ...] = ()
    environment: dict[str, str] = {}
    ended: str = ""

    @property
    def journal(self) -> Path:
        """The file of its journal, which exists once the cell was started."""
        return Path(self.folder) / JOURNAL
