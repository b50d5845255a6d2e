"""Files in the cache folder of the user, which are either complete or absent."""

from __future__ import annotations

import contextlib
import hashlib
import os
from collections.abc import Iterable, Iterator
from pathlib import Path

_DIGEST_BYTES = 32

VARIABLE = "SKILLC_CACHE"
"""The environment variable with the cache folder of skillc; its default is `skillc` in the user's."""


def cache_folder() -> Path | None:
    """Return SKILLC_CACHE, else skillc's folder in the user's cache; None for a user without a home."""
    if named := os.environ.get(VARIABLE):
        return Path(named).absolute()
    try:
        base = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    except RuntimeError:
        return None
    return base / "skillc" if base.is_absolute() else None


def load(path: Path) -> bytes | None:
    """Return what `store` wrote there; None if there is nothing, or if it is damaged."""
    try:
        content = path.read_bytes()
    except OSError:
        return None
    body = content[_DIGEST_BYTES:]
    return body if hashlib.sha256(body).digest() == content[:_DIGEST_BYTES] else None


def store(path: Path, body: bytes) -> None:
    """Write a file atomically, also if others write it; a folder that cannot be written only costs time."""
    import tempfile  # what is only read needs none

    name = None
    try:
        path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        descriptor, name = tempfile.mkstemp(dir=path.parent, prefix=".new-")
        with os.fdopen(descriptor, "wb") as file:
            file.write(hashlib.sha256(body).digest() + body)
        Path(name).replace(path)
    except OSError:
        if name is not None:
            Path(name).unlink(missing_ok=True)


def delete_oldest(folder: Path, most: int, left: int) -> None:
    """Delete the oldest files of a folder until `left` are left, if there are more than `most`.

    Other processes may delete some at the same time; a folder that cannot be read stays as it is.
    """
    with contextlib.suppress(OSError), os.scandir(folder) as entries:
        files = [each for each in entries if each.is_file()]
        ages = sorted(_ages(files)) if len(files) > most else []
        for _, path in ages[: len(ages) - left]:
            Path(path).unlink(missing_ok=True)


def _ages(files: Iterable[os.DirEntry[str]]) -> Iterator[tuple[float, str]]:
    """Yield the time of the last change of files with their paths."""
    for each in files:
        with contextlib.suppress(FileNotFoundError):
            yield each.stat().st_mtime, each.path
