"""The process of a language server for a page in a browser: `python -m skillc.workers.language_server`."""

from __future__ import annotations

import sys

from skillc.errors import OutputError, ServiceError
from skillc.lsp.server import serve
from skillc_runtime.platforms.memory import limit_memory
from skillc_runtime.platforms.priority import lower_priority

MEMORY_BYTES = 2 * 2**30
"""The largest address space of the process."""
NICENESS = 10
"""Cells come first."""


def main() -> int:
    """Serve on stdin and stdout until the input ends; return the exit code."""
    limit_memory(MEMORY_BYTES)
    lower_priority(NICENESS)
    try:
        return 0 if serve() else 1
    except (ServiceError, OutputError) as error:
        print(error, file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
