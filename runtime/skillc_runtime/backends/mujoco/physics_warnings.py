"""What the physics complains of goes to stderr; by itself MuJoCo writes MUJOCO_LOG.TXT into the working folder."""

from __future__ import annotations

import sys

import mujoco


def print_warnings() -> None:
    """Have every warning of MuJoCo told on stderr, and no file written, from now on in this process."""
    mujoco.set_mju_user_warning(_print_warning)


def _print_warning(warning: str) -> None:
    print(f"simulation: {warning}", file=sys.stderr)
