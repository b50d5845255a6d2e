"""Logs the warnings of MuJoCo."""

from __future__ import annotations

import logging

import mujoco


def log_warnings() -> None:
    """Log warnings of MuJoCo in this process, to stderr unless a program says otherwise; not to MUJOCO_LOG.TXT."""
    mujoco.set_mju_user_warning(_log_warning)


def _log_warning(warning: str) -> None:
    logging.getLogger("skillc").warning("simulation: %s", warning)
