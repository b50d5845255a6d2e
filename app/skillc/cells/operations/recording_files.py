"""Where the recordings of the operations of a cell are."""

from __future__ import annotations

from pathlib import Path

RECORDINGS = "recordings"
"""The folder of recordings in that of a cell."""


def recording_file(cell: Path, operation: str) -> Path:
    """Return the recording of an operation in the folder of its cell; there may be none."""
    return cell / RECORDINGS / f"{operation}.mcap"
