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
    costs = [found["sliding"], found["overlay"]]
    step_us = 1e6 * median(one for each in costs for one in each.physics)
    # Where physics and control are one call, a period is what is left of the loop.
    periods = [one for each in costs for one in getattr(each, "period", ())]
    loops = [one for each in costs for one in each.loop]
    period_us = 1e6 * median(periods or loops) - (0.0 if periods else step_us)
    calibration_us = (before + calibration_step_us()) / 2
    print(json.dumps({"period_us": period_us, "step_us": step_us, "calibration_us": calibration_us}))


if __name__ == "__main__":
    main(*sys.argv[1:])
