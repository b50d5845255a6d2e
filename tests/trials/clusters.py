"""A scheduler of Dask and its workers as processes of their own, with TLS between them."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import trustme

TESTS = Path(__file__).parents[1]
SETTING = "DASK_DISTRIBUTED__COMM__"


class Cluster:
    """A scheduler at an address of this machine; `environment` has the configuration with which it can be reached."""

    def __init__(self, folder: Path) -> None:
        authority, cert = trustme.CA(), folder / "cert.pem"
        authority.cert_pem.write_to_path(folder / "ca.pem")
        authority.issue_cert("127.0.0.1", "localhost").private_key_and_cert_chain_pem.write_to_path(cert)
        files = {"CA_FILE": folder / "ca.pem"}
        for role in ("CLIENT", "SCHEDULER", "WORKER"):
            files |= {f"{role}__CERT": cert, f"{role}__KEY": cert}
        self.environment = {
            **os.environ,
            **{f"{SETTING}TLS__{name}": str(file) for name, file in files.items()},
            f"{SETTING}TIMEOUTS__CONNECT": "5s",
            "DASK_DISTRIBUTED__SCHEDULER__WORKER_SATURATION": "1.0",
            "PYTHONPATH": os.pathsep.join([str(TESTS), *sys.path]),
        }
        self._file = folder / "scheduler.json"
        self.processes = [self._start("scheduler", "--protocol", "tls", "--host", "127.0.0.1", "--port", "0")]
        self.scheduler = self.processes[0]

    @property
    def address(self) -> str:
        """The address of the scheduler."""
        address: str = json.loads(self._file.read_text())["address"]
        return address

    @property
    def is_up(self) -> bool:
        """Whether the scheduler can be asked for its address."""
        return self._file.exists() and self._file.read_text().endswith("}")

    def start_worker(self, *options: str) -> subprocess.Popen[bytes]:
        """Start a worker; it has one thread."""
        words = ("--nthreads", "1", "--no-nanny", "--protocol", "tls", "--host", "127.0.0.1", *options)
        worker = self._start("worker", *words)
        self.processes.append(worker)
        return worker

    @contextmanager
    def connected(self) -> Iterator[Any]:
        """Connect a client of Dask in a `with` statement."""
        import dask
        from distributed import Client

        own = {name[5:]: value for name, value in self.environment.items() if name.startswith("DASK_")}
        settings = {name.lower().replace("__", "."): value for name, value in own.items()}
        with (
            dask.config.set(settings),
            Client(self.address, set_as_default=False) as client,
        ):
            yield client

    def end(self) -> None:
        """End all processes."""
        for each in reversed(self.processes):
            each.kill()
            each.wait()

    def _start(self, kind: str, *words: str) -> subprocess.Popen[bytes]:
        command = (sys.executable, "-m", "dask", kind, *words, "--scheduler-file", str(self._file), "--no-dashboard")
        return subprocess.Popen(command, env=self.environment, stderr=subprocess.DEVNULL, cwd=self._file.parent)
