"""What planners have answered, kept in a folder."""

from __future__ import annotations

from pathlib import Path

from skillc_dsl import cache

MOST_PLANS = 500
"""The most answers in the plan cache."""


class FolderPlanCache:
    """A plan cache as files in a folder, which several processes can share."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def get(self, key: str) -> bytes | None:
        """Return the content stored under a key, None if there is none or it is damaged."""
        return cache.load(self._folder / key)

    def put(self, key: str, content: bytes) -> None:
        """Store content under a key, and delete the oldest entries beyond MOST_PLANS."""
        cache.store(self._folder / key, content)
        cache.delete_oldest(self._folder, MOST_PLANS, MOST_PLANS)
