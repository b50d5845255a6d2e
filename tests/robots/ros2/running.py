"""Runs the simulated robot of a test in a process of its own, on loopback, in a domain of ROS 2 of its own."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from waiting import LONG_S

TESTS = Path(__file__).parents[2]
DOMAIN = str(1 + os.getpid() % 100)
"""Tests that run beside each other do not see each other's topics."""
LOOPBACK = {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST", "ROS_DOMAIN_ID": DOMAIN}


class Robot:
    """A simulated robot that runs."""

    def __init__(self, process: subprocess.Popen[str], report: Path) -> None:
        self.process, self._report = process, report

    def pause(self) -> None:
        """Let it do nothing from now on."""
        self.process.send_signal(signal.SIGSTOP)

    def go_on(self) -> None:
        """Let it go on after `pause`."""
        self.process.send_signal(signal.SIGCONT)

    def kill(self) -> None:
        """End it at once."""
        self.process.kill()
        self.process.wait(LONG_S)

    def end(self) -> dict[str, Any]:
        """End it and return its report."""
        self.go_on()
        self.process.send_signal(signal.SIGTERM)
        self.process.wait(LONG_S)
        found: dict[str, Any] = json.loads(self._report.read_text("utf-8"))
        return found


@contextmanager
def robot(scene: Path, folder: Path, **options: Any) -> Iterator[Robot]:
    """Run a simulated robot in a `with` statement; options are those of `peer.Options`."""
    report = folder / "report.json"
    wanted = json.dumps({"scene": str(scene), "report": str(report), **options})
    path = os.pathsep.join([str(TESTS), os.environ.get("PYTHONPATH", "")])
    process = subprocess.Popen(
        [sys.executable, "-m", "robots.ros2.peer", wanted],
        stdout=subprocess.PIPE, text=True, env={**os.environ, **LOOPBACK, "PYTHONPATH": path},
    )  # fmt: skip
    try:
        assert process.stdout is not None
        assert process.stdout.readline() == "ready\n"
        yield Robot(process, report)
    finally:
        process.kill()
        process.wait(LONG_S)
