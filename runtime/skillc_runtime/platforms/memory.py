"""How much memory this machine has, and how much of it this process can still use."""

from __future__ import annotations

import os
import sys
from contextlib import suppress
from pathlib import Path

_MEMORY = Path("/proc/meminfo")
_LIMIT, _USED = Path("/sys/fs/cgroup/memory.max"), Path("/sys/fs/cgroup/memory.current")
_OWN = Path("/proc/self/statm")


def physical_bytes() -> int | None:
    """Return the memory of this machine in bytes; None if unknown."""
    if sys.platform == "win32":
        return None
    return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")


def available_bytes() -> int | None:
    """Return how many bytes this process can still use; None if unknown.

    Considers the machine and the container, on Linux, and the limits of the process.
    """
    known = [left for left in (_of_machine(), _of_container(), _of_limit()) if left is not None]
    return max(min(known), 0) if known else None


def limit_memory(most_bytes: int) -> None:
    """Let this process use an address space of `most_bytes` at most, where the system has such a limit."""
    if sys.platform != "win32":
        import resource

        _, hard = resource.getrlimit(resource.RLIMIT_AS)
        resource.setrlimit(resource.RLIMIT_AS, (most_bytes if hard < 0 else min(most_bytes, hard), hard))


def _of_machine() -> int | None:
    with suppress(OSError, ValueError):
        fields = dict(line.split(":", 1) for line in _MEMORY.read_text("ascii").splitlines())
        return int(fields.get("MemAvailable", "").split()[0]) * 1024 if "MemAvailable" in fields else None
    return None


def _of_container() -> int | None:
    with suppress(OSError, ValueError):
        return int(_LIMIT.read_text("ascii")) - int(_USED.read_text("ascii"))
    return None


def _of_limit() -> int | None:
    if sys.platform == "win32":
        return None
    import resource

    limit, _ = resource.getrlimit(resource.RLIMIT_AS)
    with suppress(OSError, ValueError):
        used = int(_OWN.read_text("ascii").split()[0]) * os.sysconf("SC_PAGE_SIZE")
        return None if limit == resource.RLIM_INFINITY else limit - used
    return None
