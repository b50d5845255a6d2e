"""Starts other programs so that they stay within limits, and that they and their descendants end with this process.

Windows has neither the limits nor the groups of processes: there a program is only started and ended.
"""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import IO

NOT_STARTED = 127
"""The exit code of a sandbox whose program cannot be started; the last line of its output is the reason."""

CLEANUP_S = 1.0
"""How long the sandbox may take to end the program's children before both are killed."""


def start_sandboxed(
    command: Sequence[str],
    folder: Path,
    limits: tuple[int, int],
    streams: tuple[IO[bytes], IO[bytes]],
    environment: Mapping[str, str] | None,
    is_temporary: bool,
) -> subprocess.Popen[bytes]:
    """Start a program in a folder, which is removed with this process if it `is_temporary`; OSError if that fails.

    limits: of the address space and of the size of a file, in bytes; streams: of its input, and of both its outputs.
    """
    source, output = streams
    if sys.platform != "win32":
        from skillc_runtime.platforms import sandbox_program

        sandbox = (sys.executable, "-I", "-S", sandbox_program.__file__, str(os.getpid()))
        command = (*sandbox, *map(str, limits), str(folder) if is_temporary else "", *command)
    return subprocess.Popen(
        command,
        cwd=folder,
        stdin=source,
        stdout=output,
        stderr=subprocess.STDOUT,
        start_new_session=True,
        env=None if environment is None else {**os.environ, **environment},
    )


def end_sandboxed(process: subprocess.Popen[bytes]) -> None:
    """End a program that was started here, and all its descendants."""
    if process.poll() is None:
        process.terminate()
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(CLEANUP_S)
    if sys.platform == "win32":
        process.kill()
    else:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
    with contextlib.suppress(subprocess.TimeoutExpired):  # a process in a call of a broken driver cannot be killed
        process.wait(CLEANUP_S)
