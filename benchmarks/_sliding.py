"""Runs one shipped task, and has what a control period and a step of physics cost while a tool slides in contact.

`python _sliding.py LIBRARY TASK` prints a line of JSON. `control` is that of the checkout whose benchmarks come first
in PYTHONPATH: each fits its own code.
"""

from __future__ import annotations

import json
import sys
from statistics import median

from _calibration import calibration_step_us

from control import take_apart


def main(library: str, task: str) -> None:
    """Print the medians of control period and step in us, with and without an overlay, and the calibration step."""
    before = calibration_step_us()
    found = take_apart(library, task)
    periods, steps = (
        [1e6 * each for kind in ("sliding", "overlay") for each in getattr(found[kind], part)]
        for part in ("period", "physics")
    )
    calibration_us = (before + calibration_step_us()) / 2
    print(json.dumps({"period_us": median(periods), "step_us": median(steps), "calibration_us": calibration_us}))


if __name__ == "__main__":
    main(*sys.argv[1:])
