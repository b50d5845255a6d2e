"""What stands at a path that a user names; nothing is opened, and no path is too odd to be looked at."""

from __future__ import annotations

import errno
import stat
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

Kind = Literal["file", "folder", "missing", "unusable"]


@dataclass(frozen=True, slots=True)
class Found:
    """What a path leads to. `is_what` goes on with a sentence that begins with the path: `is a folder`."""

    kind: Kind
    is_what: str


_NOWHERE = Found("unusable", "is a link that leads nowhere")


def look(path: Path) -> Found:
    """Look at what a path leads to; pipes, devices, links to nothing and impossible names are `unusable`."""
    try:
        mode = path.stat().st_mode
    except (FileNotFoundError, NotADirectoryError):
        return _NOWHERE if path.is_symlink() else Found("missing", "is missing")
    except (OSError, ValueError) as error:
        if isinstance(error, OSError) and error.errno == errno.ELOOP:
            return _NOWHERE
        reason = error.strerror if isinstance(error, OSError) else str(error)
        return Found("unusable", f"cannot be opened: {reason}")
    if stat.S_ISREG(mode):
        return Found("file", "is a file")
    return Found("folder", "is a folder") if stat.S_ISDIR(mode) else Found("unusable", "is not a regular file")
