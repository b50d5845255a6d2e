"""Kills a server or its cell at random moments, and prints what was lost: `make soak`, KILLS times from SEED."""

from __future__ import annotations

import argparse
import sys
import tempfile
from dataclasses import asdict, astuple
from pathlib import Path

from killed_servers.auditing import Faults
from killed_servers.series import KillSeries, add_up


def main() -> int:
    options = _options()
    found = Faults()
    with tempfile.TemporaryDirectory() as folder:
        series = KillSeries(Path(folder), options.seed)
        try:
            for number, each in enumerate(series.kill(options.kills), 1):
                found = add_up(found, each)
                print(f"\r{number} of {options.kills}", end="", file=sys.stderr, flush=True)
        finally:
            series.end()
    print(file=sys.stderr)
    for name, count in (*sorted(series.counts.items()), *asdict(found).items()):
        print(f"{count:6}  {name.replace('_', ' ')}")
    return int(any(astuple(found)))


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="killed_servers", description=__doc__)
    parser.add_argument("--kills", type=int, default=200, help="how often a server or its cell is killed")
    parser.add_argument("--seed", type=int, default=0, help="determines the moments")
    return parser.parse_args()


if __name__ == "__main__":
    sys.exit(main())
