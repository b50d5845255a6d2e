"""Reports of internal errors: users see one message, and the traceback is written to a file.

Every command imports this module, so it imports what only a report needs inside the functions.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path


def write_report(error: BaseException, arguments: Sequence[str]) -> str:
    """Write a report of `error` to a file; return the message for the user, which names the file."""
    import shlex

    command = shlex.join(["skillc", *arguments])
    return (
        f"internal error: `{command}` failed with {type(error).__name__}: {_first_line(error)}\n"
        f"help: this is a bug in skillc, not an error in your files; {_write(error, command)}"
    )


def format_report(error: BaseException, command: str) -> str:
    """Return a report: versions, platform, command, folder and traceback."""
    import platform
    import traceback
    from importlib.metadata import version

    about = f"skillc {version('skillc')}, Python {platform.python_version()}, {platform.platform()}"
    trace = "".join(traceback.format_exception(error))
    return f"{about}\n{command}\nin {_folder()}\n\n{trace}"


def _write(error: BaseException, command: str) -> str:
    import tempfile

    try:
        descriptor, name = tempfile.mkstemp(prefix="skillc-crash-", suffix=".txt")
        with os.fdopen(descriptor, "w", encoding="utf-8", errors="backslashreplace") as file:
            file.write(format_report(error, command))
    except OSError as reason:
        return f"please report it; no report could be written: {reason.strerror}"
    return f"please report it with the file {name}"


def _first_line(error: BaseException) -> str:
    return (str(error).splitlines() or ["no message"])[0]


def _folder() -> str:
    try:
        return str(Path.cwd())
    except OSError:
        return "a folder that is gone"
