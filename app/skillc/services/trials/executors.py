"""Where trials run: in processes of this machine, or on the workers of a scheduler of Dask."""

from __future__ import annotations

import logging
import os
from collections.abc import Iterator, Mapping
from concurrent.futures import Executor, ThreadPoolExecutor
from contextlib import contextmanager
from functools import partial
from typing import Any
from urllib.parse import urlsplit

from skillc.client.address import is_loopback
from skillc.errors import RequestError, ServiceError
from skillc.extras import naming_extras, require
from skillc.services.reporting.reporter import Reporter
from skillc.services.trials.running import OpenExecutor

CONNECT_S = 30.0
"""How long a scheduler may take to answer, in s."""


def choose_executor(jobs: int | None, scheduler: str | None, number: int, reporter: Reporter) -> OpenExecutor:
    """Return what runs `number` trials: `jobs` processes, by default one for each core, or those of a scheduler.

    RequestError for both, for a scheduler that cannot be used, or if Dask is not installed.
    """
    if scheduler is None:
        # A thread for each process: it waits for the process, and ends it if need be.
        return partial(ThreadPoolExecutor, min(jobs or os.cpu_count() or 1, number))
    if jobs is not None:
        raise RequestError(
            "--jobs is the number of processes here; with --scheduler its workers run the trials: give one of them"
        )
    _require_secret(scheduler, f"--scheduler {scheduler}")
    require("--scheduler", "cluster")
    return partial(_connect, scheduler, reporter)


@contextmanager
def _connect(address: str, reporter: Reporter) -> Iterator[Executor]:
    """Connect to a scheduler and its workers. ServiceError if it does not answer, or they cannot be used."""
    with naming_extras():
        from distributed import Client
    logging.getLogger("distributed").setLevel(logging.CRITICAL)  # it tells of each result that nobody wants any more
    try:
        client: Any = Client(address, timeout=CONNECT_S, set_as_default=False)
    except (OSError, ValueError, TypeError) as error:
        raise ServiceError(f"no scheduler of Dask answers at {address}: {error}") from error
    try:
        workers: Mapping[str, Mapping[str, Any]] = client.scheduler_info(n_workers=-1)["workers"]
        for worker, about in workers.items():
            _require_secret(worker, f"the worker {worker}")
            if about["nthreads"] != 1:
                raise ServiceError(f"the worker {worker} has {about['nthreads']} threads; start it with --nthreads 1")
        if not workers:
            reporter.say(f"no worker is connected to {address}; the trials wait for one")
        yield client.get_executor(pure=False)
    finally:
        client.close(timeout=1.0)


def _require_secret(address: str, who: str) -> None:
    """Raise RequestError for an address beyond this machine without TLS: what travels is code."""
    parts = urlsplit(address if "://" in address else f"tcp://{address}")
    if parts.scheme in ("tls", "wss", "inproc") or is_loopback(parts.hostname or ""):
        return
    secret = f"tls://{parts.netloc}"
    raise RequestError(
        f"{who} is on another machine, and what is sent there is code: use TLS, {secret}, with the certificates in the "
        "configuration of Dask, `distributed.comm.tls`"
    )
