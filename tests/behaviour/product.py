"""The product as its users have it: its commands, in processes of their own, in a folder without a project."""

from __future__ import annotations

import json
import os
import shlex
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

CASES = Path(__file__).parents[1]
"""The folder of all tests, some of whose cases are input."""


@dataclass(frozen=True, slots=True)
class Product:
    """Runs commands in the folder `work`, with variables of the `environment` beside those of this process."""

    work: Path
    environment: dict[str, str] = field(default_factory=dict)

    def start(self, *words: str) -> subprocess.Popen[str]:
        """Start a command."""
        return subprocess.Popen(
            (sys.executable, "-m", "skillc", *words),
            cwd=self.work,
            env=os.environ | {"COLUMNS": "200", "NO_COLOR": "1"} | self.environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )

    def tell(self, *words: str) -> str:
        """Run a command; return how it ended and all that it printed."""
        process = self.start(*words)
        out, err = process.communicate()
        return f"$ skillc {shlex.join(words)}\nexit code {process.returncode}\n--- stdout\n{out}\n--- stderr\n{err}\n"

    def answer(self, *words: str) -> Any:
        """Run a command that prints JSON, whatever its exit code; return what it prints."""
        out, err = self.start(*words, "--json").communicate()
        return json.loads(out) if out else err

    def tasks(self) -> list[dict[str, Any]]:
        """Return the shipped tasks."""
        return list(self.answer("tasks"))


def write(path: Path, text: str) -> None:
    """Write a text, and the folders above it."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def file_name(text: str) -> str:
    """Return a text as the name of a file."""
    return "".join(each if each.isalnum() or each in "-_" else "-" for each in text)
