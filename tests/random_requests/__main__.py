"""Sends random requests to a server of a yard, and prints what it answered and what was wrong: `make soak`."""

from __future__ import annotations

import argparse
import sys
import tempfile
from pathlib import Path

from random_requests.sending import send_requests
from server.running import serving


def main() -> int:
    options = _options()
    with tempfile.TemporaryDirectory() as folder, serving(Path(folder)) as server:
        answers = send_requests(server, Path(folder), options.examples, options.seed)
    for status, count in sorted(answers.statuses.items()):
        print(f"{count:6}  {status}")
    print(f"{answers.statuses.total():6}  requests, of {answers.operations} kinds")
    for each in answers.faults:
        print(each)
    return int(bool(answers.faults))


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="random_requests", description=__doc__)
    parser.add_argument("--examples", type=int, default=500, help="how many requests of each kind, at most")
    parser.add_argument("--seed", type=int, default=0, help="determines the requests")
    return parser.parse_args()


if __name__ == "__main__":
    sys.exit(main())
