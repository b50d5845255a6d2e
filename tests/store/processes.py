"""Starting writers and hearing what they were told is kept."""

import subprocess
import sys
from pathlib import Path

WRITER = Path(__file__).with_name("writer.py")


def writer(place: str | Path, seed: int, count: int, name: str) -> "subprocess.Popen[str]":
    """Start a process that writes to a store."""
    command = [sys.executable, str(WRITER), str(place), str(seed), str(count), name]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def told(process: "subprocess.Popen[str]") -> list[str]:
    """Return the complete lines that a process wrote until its end."""
    out, _ = process.communicate(timeout=120)
    return out.split("\n")[:-1]
