"""Plans in the user's cache folder: the newest are kept."""

from __future__ import annotations

import contextlib
from collections.abc import Iterable
from pathlib import Path

from skillc_dsl.keeping import cache_folder, keep, kept

MOST = 500
"""So many answers are kept."""


class FolderShelf:
    """Answers as files of a folder, for several processes at once."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def get(self, key: str) -> bytes | None:
        """Return what was kept under a key, None where there is nothing or where it is damaged."""
        return kept(self._folder / key)

    def put(self, key: str, content: bytes) -> None:
        """Keep something, and throw the oldest away where there is too much."""
        keep(self._folder / key, content)
        with contextlib.suppress(OSError):
            files = sorted(_ages(self._folder.iterdir()))
            for _, path in files[: max(0, len(files) - MOST)]:
                path.unlink(missing_ok=True)


def user_shelf() -> FolderShelf | None:
    """Return the user's own, None for a user without a home."""
    folder = cache_folder()
    return None if folder is None else FolderShelf(folder / "plans")


def _ages(paths: Iterable[Path]) -> Iterable[tuple[float, Path]]:
    """Yield files with the time of their last change; others may remove some in the meantime."""
    for path in paths:
        with contextlib.suppress(FileNotFoundError):
            if path.is_file():
                yield path.stat().st_mtime, path
