"""What was found in libraries that were checked before, so that nothing is done twice.

A verdict is kept under the digest of everything it depends on, so that one that does not hold any more is never found.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.keeping import cache_folder, keep, kept
from skillc_dsl.rendering import json
from skillc_runtime.commands._digests import digest_of
from skillc_runtime.commands._files import LibraryFiles

_MOST = 500
"""Verdicts that are kept; beyond, the older half is forgotten."""


@dataclass(frozen=True, slots=True)
class Case:
    """A library, with a scene or without, as it was when its `digest` was taken."""

    library: LibraryFiles
    scene: Path | None
    digest: str

    @staticmethod
    def of(library: LibraryFiles, scene: Path | None) -> Case:
        """Take the digest of how things are now."""
        return Case(library, scene, digest_of(library, scene))

    def recall(self) -> tuple[Diagnostic, ...] | None:
        """Return what was found in this case before; None if it is new."""
        path = self._path()
        body = kept(path) if path else None
        return None if body is None else json.read(body.decode())

    def remember(self, found: Sequence[Diagnostic]) -> None:
        """Keep what was found, unless something has changed meanwhile, so that nobody knows what was checked."""
        path = self._path()
        if path is not None and digest_of(self.library, self.scene) == self.digest:
            keep(path, json.render(found, {}).encode())
            _forget(path.parent)

    def _path(self) -> Path | None:
        folder = cache_folder()
        return folder / "verdicts" / self.digest if folder else None


def _forget(folder: Path) -> None:
    """Delete the older half of too many verdicts; what others delete at the same time is gone as well."""
    try:
        verdicts = sorted(folder.iterdir(), key=lambda path: path.stat().st_mtime_ns)
        for path in verdicts[: len(verdicts) - _MOST // 2] if len(verdicts) > _MOST else ():
            path.unlink(missing_ok=True)
    except OSError:
        return
