"""The loader `load_trees.cpp` as a process that traces one file after the other."""

from __future__ import annotations

import subprocess
from functools import cache
from pathlib import Path


class Loader:
    """A running loader; it ends with its owner."""

    def __init__(self, binary: Path) -> None:
        self._process = subprocess.Popen([binary], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def trace(self, path: Path) -> list[str]:
        """Return the trace of a file; the last line says how it ended or why it was refused."""
        assert self._process.stdin is not None and self._process.stdout is not None
        self._process.stdin.write(f"{path.resolve()}\n")
        self._process.stdin.flush()
        lines: list[str] = []
        for line in self._process.stdout:
            lines.append(line.rstrip("\n"))
            if line.startswith(("end ", "refused ")):
                return lines
        raise AssertionError(f"the loader died of {path}, exit code {self._process.wait()}")


@cache
def loader(binary: Path) -> Loader:
    """Return the loader of a binary, started once."""
    return Loader(binary)
