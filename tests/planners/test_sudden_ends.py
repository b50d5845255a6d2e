"""Who plans is killed or interrupted: what the planner started ends, what it wrote is removed."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from planners.programs import HANG, ends, program, started
from waiting import LONG_S, wait_until

TESTS = Path(__file__).parents[1]
TRANSLATED = 'touch task.sas; echo "Translator axioms: 0"'


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="needs the parent death signal of Linux")
@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGINT])
def test_nothing_is_left_of_planners_when_who_asked_is_gone(how: signal.Signals, tmp_path: Path) -> None:
    work = tmp_path / "work"
    work.mkdir()
    search, translate = program(tmp_path, "search", HANG), program(tmp_path, "translate", TRANSLATED)
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join((str(TESTS), *sys.path)), "TMPDIR": str(work)}
    command = (sys.executable, str(TESTS / "planners/planning_alone.py"), search, translate)
    asking = subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    wait_until(lambda: len(started(tmp_path)) == 4)  # both searches and what they started run
    assert list(work.iterdir())
    asking.send_signal(how)
    asking.communicate(timeout=LONG_S)
    assert asking.returncode != 0
    assert all(ends(pid) for pid in started(tmp_path))
    wait_until(lambda: not list(work.iterdir()))
