"""How many workers of Dask trials keep busy: trials that only sleep, on processes of this machine.

`cluster.py [WORKERS [SECONDS]]`: each worker gets ROUNDS trials that sleep.
"""

from __future__ import annotations

import sys
import time
from dataclasses import dataclass
from functools import partial
from importlib.util import find_spec

from skillc_runtime.evaluation.trials.dispatch import run_on
from skillc_runtime.evaluation.trials.trial import Trial

WORKERS, SECONDS, ROUNDS = 64, 10.0, 4
SETTINGS = {
    "distributed.scheduler.worker-saturation": 1.0,  # as docs/how-to/many-machines.md has it
    # All workers share a few cores here: they start as forks of one process, and Dask does not sample their stacks.
    "distributed.worker.multiprocessing-method": "forkserver",
    "distributed.worker.profile.enabled": False,
}


@dataclass(frozen=True, slots=True)
class Sleeper:
    """Sleeps."""

    seconds: float

    def run(self, seed: int) -> Trial:
        time.sleep(self.seconds)
        return Trial(seed=seed, status="succeeded")


def measure(workers: int, seconds: float) -> tuple[float, float]:
    """Return the share of their time in which workers that have started sleep: in trials, and in bare tasks of Dask."""
    import dask
    from distributed import Client, LocalCluster

    dask.config.set(SETTINGS)
    options = {"n_workers": workers, "threads_per_worker": 1, "dashboard_address": None, "memory_limit": 0}
    with LocalCluster(**options) as cluster, Client(cluster, set_as_default=False) as client:
        client.wait_for_workers(workers)
        executor, sleeper, count = client.get_executor(pure=False), partial(Sleeper, seconds), ROUNDS * workers
        list(run_on(executor, sleeper, range(workers)))  # each has its process now
        began = time.perf_counter()
        tried = list(run_on(executor, sleeper, range(count)))
        ended = time.perf_counter()
        client.gather(client.map(time.sleep, [seconds] * count, pure=False))
        bare_s = time.perf_counter() - ended
    assert len(tried) == count
    return ROUNDS * seconds / (ended - began), ROUNDS * seconds / bare_s


if __name__ == "__main__":
    asked = sys.argv[1:]
    workers, seconds = int(asked[0]) if asked else WORKERS, float(asked[1]) if len(asked) > 1 else SECONDS
    if find_spec("distributed") is None:
        print("Dask is not installed: pip install 'skillc[cluster]'")
    else:
        share, bare = measure(workers, seconds)
        print(f"{workers} workers sleep {share:.0%} of the time of {ROUNDS * workers} trials of {seconds:g} s")
        print(f"They sleep {bare:.0%} of the time of as many tasks of Dask that only sleep")
