"""Prints the warnings of MuJoCo."""

from __future__ import annotations

import sys

import mujoco


def print_warnings() -> None:
    """Print warnings of MuJoCo to stderr in this process; by default it writes MUJOCO_LOG.TXT."""
    mujoco.set_mju_user_warning(_print_warning)


def _print_warning(warning: str) -> None:
    print(f"simulation: {warning}", file=sys.stderr)
