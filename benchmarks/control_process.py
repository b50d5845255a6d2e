"""The jitter of a control process at 1 kHz beside that of an empty loop of the same priority, and what a period costs.

Nothing moves: the link waits for the next period and returns the posture at home. `--periods N` sets how many periods
each is run (20,000); `--hour` runs 3.6 million, which takes an hour. `--together` runs the empty loop and the arm of
the first scene at once, so that the machine is as busy for both. `--load` lets a process beside them make and collect
garbage; SKILLC_COMPILED=0 in the environment runs the laws as plain Python.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from time import monotonic, perf_counter, sleep
from typing import Any

import numpy as np

from skillc_dsl.source import Source
from skillc_ontology import catalogue
from skillc_rdf.vocabulary.load import load
from skillc_runtime.backends.control_process.handshake import ControlTask, Patience
from skillc_runtime.backends.control_process.link import (
    LinkAbilities,
    make_state,
)
from skillc_runtime.backends.control_process.memory_plan import TIME, MemoryPlan
from skillc_runtime.backends.control_process.periods.controlled_arm import ControlledArm
from skillc_runtime.backends.control_process.periods.pacing import CycleClock
from skillc_runtime.backends.control_process.periods.publisher import StatePublisher
from skillc_runtime.backends.control_process.remote.host import ControlProcess
from skillc_runtime.backends.simulation.scene_reading import read_scene_spec
from skillc_runtime.backends.simulation.scene_spec import ArmSpec
from skillc_runtime.devices.guarded_push import GuardedPush, Travel
from skillc_runtime.motion.pose import Array
from skillc_runtime.scene.load import load_scene

sys.path.insert(0, str(Path(__file__).parent.parent / "tests"))
from control_process.still_link import PERIOD_S, StillDescription

HOUR = 3_600_000
SCENES = ("iiwa_table", "ur5e_whiteboard")
GARBAGE = "import gc\nwhile True:\n    rows = [[{} for _ in range(100)] for _ in range(1000)]\n    gc.collect()"
EMPTY = """
import sys
from time import monotonic
import numpy as np
from skillc_runtime.backends.control_process.periods.pacing import Pacer
from skillc_runtime.platforms.real_time import run_in_real_time
times = np.ones(int(sys.argv[1]))
run_in_real_time()
pacer = Pacer(0.001)
for number in range(times.size):
    pacer.wait()
    times[number] = monotonic()
sys.stdout.buffer.write(times.tobytes())
"""


def read_arm(scene: str) -> tuple[ArmSpec, dict[str, str], StillDescription]:
    vocabulary = load([Source(path, text) for path, text in catalogue.vocabulary_files()]).value
    spec = read_scene_spec(load_scene(catalogue.scene_path(scene), vocabulary))
    facts = spec.arms[0]
    abilities = LinkAbilities(facts.modes, wrench="without-weight", measures_effort=True)
    return facts, spec.names, StillDescription(tuple(facts.home.tolist()), abilities)


def run_process(scene: str, periods: int) -> Array:
    """Return when each cycle of a control process began, in s, while its arm pushes."""
    facts, names, description = read_arm(scene)
    patience = Patience(tree_s=30.0, process_s=30.0, gap_s=30.0)
    process = ControlProcess(ControlTask(facts, names, description, patience))
    try:
        process.call_device("take_control")
        process.call("motion", "hold_position")
        along = process.read().state.tool.rotation[:, 2].copy()
        process.call("compliance", "release", along)
        process.call("compliance", "start_push", GuardedPush(-along, 1.0, 0.001, Travel(1.0)))
        process.ring.take()
        times: list[Array] = []
        while sum(map(len, times)) < periods:
            sleep(0.5)
            times.append(process.ring.take()[:, TIME])
        return np.concatenate(times)[:periods]
    finally:
        process.close()


def run_empty(periods: int) -> Array:
    """Return when each cycle of an empty loop began, in s."""
    ran = subprocess.run([sys.executable, "-c", EMPTY, str(periods)], stdout=subprocess.PIPE, check=True)
    return np.frombuffer(ran.stdout)


def describe(name: str, times: Array) -> None:
    late = np.diff(times) / PERIOD_S - 1.0
    missed = int((late >= 1.0).sum())
    p50, p99, p9999, most = np.percentile(late, [50, 99, 99.99, 100])
    per_million = 1e6 * missed / len(late)
    jitter = f"late by p50 {p50:6.3f}  p99 {p99:6.3f}  p99.99 {p9999:6.3f}  max {most:7.2f} periods"
    print(f"{name:28} {jitter}; missed {per_million:8.0f} in a million", flush=True)


def measure_costs(scene: str, periods: int = 3000) -> None:
    """Print what the parts of a period cost, as shares of it."""
    facts, names, description = read_arm(scene)
    arm, measured = ControlledArm(facts, names, description.abilities, PERIOD_S), make_state(facts.home.size)
    measured.buffer[:] = 0.0
    measured.q[:] = measured.target[:] = facts.home
    arm.begin(measured, 0.0)
    arm.driver.motion.hold_position()
    plan = MemoryPlan(facts.home.size)
    publisher = StatePublisher(plan, np.zeros(plan.size), arm, measured, CycleClock(PERIOD_S))
    parts: dict[str, Any] = {
        "model": lambda now: arm.arm.measure(measured, now),
        "model, law, limits": lambda now: arm.step(measured, now),
        "publishing": lambda now: publisher.publish("in-control", now),
    }
    for part, call in parts.items():
        costs = []
        call(0.0)
        for cycle in range(1, periods):
            began = perf_counter()
            call(cycle * PERIOD_S)
            costs.append((perf_counter() - began) / PERIOD_S)
        p50, p99, most = np.percentile(costs, [50, 99, 100])
        print(f"  {part:26} p50 {p50:6.3f}  p99 {p99:6.3f}  max {most:7.2f} periods")


def run_apart(periods: int) -> None:
    """Run the empty loop and each arm, one after the other."""
    describe("empty loop", run_empty(periods))
    for scene in SCENES:
        describe(scene, run_process(scene, periods))
        measure_costs(scene)


def run_together(periods: int) -> None:
    """Run the empty loop and the arm of the first scene at once."""
    with ThreadPoolExecutor() as pool:
        found = {"empty loop": pool.submit(run_empty, periods), SCENES[0]: pool.submit(run_process, SCENES[0], periods)}
    for name, times in found.items():
        describe(f"{name}, together", times.result())


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--periods", type=int, default=20_000)
    options.add_argument("--hour", action="store_const", const=HOUR, dest="periods")
    options.add_argument("--together", action="store_true")
    options.add_argument("--load", action="store_true")
    given = options.parse_args()
    load_process = subprocess.Popen([sys.executable, "-c", GARBAGE]) if given.load else None
    began = monotonic()
    try:
        (run_together if given.together else run_apart)(given.periods)
    finally:
        if load_process is not None:
            load_process.kill()
    print(f"in {monotonic() - began:.0f} s", file=sys.stderr)


if __name__ == "__main__":
    main()
