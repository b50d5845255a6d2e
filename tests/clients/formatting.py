"""Formats a module that is made, as those that are written."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import skillc
from docs.pages import ROOT
from waiting import LONG_S

CLIENT = Path(skillc.__file__).parent / "client"


def format_module(text: str, file: Path) -> str:
    """Return the text of a module for a file, without imports that it does not need."""
    ruff = (sys.executable, "-m", "ruff")
    for command in (
        ("check", "--select", "F401,I", "--fix", "--quiet", "--exit-zero", "--no-cache"),
        ("format", "--quiet", "--no-cache"),
    ):
        done = subprocess.run(
            (*ruff, *command, "--stdin-filename", str(file), "-"),
            input=text, cwd=ROOT, capture_output=True, text=True, encoding="utf-8", timeout=LONG_S, check=True,
        )  # fmt: skip
        text = done.stdout
    return text
