"""Servers that the tests of this folder share; each test leaves no operation behind that goes on, and texts as valid.

There are a few of them, since starting one takes long.
"""

from __future__ import annotations

from collections.abc import Iterator

import pytest
import trustme

from running_cells.asking import write_asking_yard
from server.misbehaving import write_misbehaving
from server.running import RunningServer, serving, serving_bench


@pytest.fixture(scope="package")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningServer]:
    """A server of a yard in which somebody may be asked, with a text beside its folder that is none of it."""
    folder = tmp_path_factory.mktemp("server") / "yard"
    write_asking_yard(folder)
    (folder.parent / "secret.skill").write_text("## A secret.\nskill Secret {\n    noplan\n}\n")
    with serving(folder) as running:
        yield running


@pytest.fixture(scope="package")
def bench(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningServer]:
    """A server of a yard and of the cell `bench`, whose library has skills that misbehave."""
    folder = tmp_path_factory.mktemp("bench")
    write_misbehaving(folder)
    with serving_bench(folder) as running:
        yield running


@pytest.fixture(scope="package")
def encrypted(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningServer]:
    """A server with a certificate, also for `cells.example.org`."""
    folder, authority = tmp_path_factory.mktemp("encrypted"), trustme.CA()
    certificate = authority.issue_cert("127.0.0.1", "cells.example.org")
    certificate.cert_chain_pems[0].write_to_path(str(folder / "chain.pem"))
    certificate.private_key_pem.write_to_path(str(folder / "key.pem"))
    authority.cert_pem.write_to_path(str(folder / "ca.pem"))
    files = ("--tls-cert", folder / "chain.pem", "--tls-key", folder / "key.pem")
    with serving(folder, options=(*files, "--host", "cells.example.org"), authority=folder / "ca.pem") as running:
        yield running


@pytest.fixture(scope="package")
def proxied(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningServer]:
    """A server behind a proxy on this machine, with a log in the file `log`."""
    folder = tmp_path_factory.mktemp("proxied")
    with serving(folder, options=("--behind-proxy", "127.0.0.1", "--log", folder / "log")) as running:
        yield running
