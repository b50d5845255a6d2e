"""Runs `skillc` with searches for a path that take longer than a tick may: `slow_search.py SECONDS ARGUMENT..`."""

from __future__ import annotations

import sys
import time

from skillc.cli.main import main
from skillc_runtime.collision import motion_search, path_planning
from skillc_runtime.collision.path_planning import plan_joint_path


def run_slowly(seconds: float) -> None:
    """Run the command line; each search takes so long, and finds nothing around what is in the way."""

    def search(*arguments: object) -> object:
        time.sleep(seconds)
        return plan_joint_path(*arguments)  # type: ignore[arg-type]

    path_planning.SEARCHES = ()
    motion_search.plan_joint_path = search  # type: ignore[assignment]
    main()


if __name__ == "__main__":
    how_long = float(sys.argv.pop(1))
    run_slowly(how_long)
