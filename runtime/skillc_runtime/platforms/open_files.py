"""How many files and sockets this process may have open."""

from __future__ import annotations

import sys

MAX_OPEN_FILES = 65536


def raise_open_files_limit() -> None:
    """Let this process open as many files as its user may, up to MAX_OPEN_FILES."""
    if sys.platform == "win32":
        return
    import resource

    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    wanted = MAX_OPEN_FILES if hard == resource.RLIM_INFINITY else min(hard, MAX_OPEN_FILES)
    if soft != resource.RLIM_INFINITY and soft < wanted:
        resource.setrlimit(resource.RLIMIT_NOFILE, (wanted, hard))
