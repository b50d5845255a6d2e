"""Cells that share a world on a server, each a process with a library and a robot of its own."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from urllib.parse import urlsplit

import pyoxigraph as ox
import pytest

from skillc.services.scene.stores import describe_author, open_store
from store.proxy import FAULTS, Proxy, proxy_to
from store.servers import oxigraph
from store.worlds import model_of
from waiting import LONG_S, wait_until
from world.lab import assign

HALL = """use skiros, skillc

class Cart < MobileRobot
class Place < Location
class Load < Product
relation serves(Cart, Place)
"""
SKILL = """import "hall/hall.skill"
use skiros
prefix lab: <http://example.org/lab#>

skill {skill} {{
    in    cart: Cart
    in    load: Load
    in    to:   Place
    infer from: Place
    pre   cart serves from
    pre   cart serves to
    pre   from contain load
    pre   not from == to
    post  to contain load
    post  not from contain load
    duration 500 ms
    uses  cart
}}

impl it of {skill} {{ run python "skillc.primitives:StandIn" }}

task hand_over {{
    scene "../hall/hall.ttl"
    {task}
}}
"""
FEEDING = SKILL.format(skill="Feed", task="goal lab:Shared contain lab:Load-1")
PACKING = SKILL.format(
    skill="Pack",
    task="""do    seq {
        wait until (lab:Shared contain lab:Load-1)
        Pack(cart: lab:B, load: lab:Load-1, to: lab:Box)
    }""",
)
SCENE = """@prefix hall:   <https://w3id.org/skillc/library/hall#> .
@prefix lab:    <http://example.org/lab#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .

lab:A a hall:Cart ; hall:serves lab:Store, lab:Shared .
lab:B a hall:Cart ; hall:serves lab:Shared, lab:Box .
lab:Store a hall:Place ; skiros:contain lab:Load-1 .
lab:Shared a hall:Place .
lab:Box a hall:Place .
lab:Load-1 a hall:Load .
"""
MANIFEST = 'name = "{name}"\n\n[dependencies]\nhall = {{ path = "../hall" }}\n\n[tool.run]\nbackend = "symbolic"\n'


@pytest.fixture
def cells(tmp_path: Path) -> Path:
    """Return a folder with two libraries and the one that both import."""
    for name, text in (("hall", HALL), ("feeding", FEEDING), ("packing", PACKING)):
        (tmp_path / name).mkdir()
        (tmp_path / name / f"{name}.skill").write_text(text, encoding="utf-8")
        (tmp_path / name / "skillc.toml").write_text(MANIFEST.format(name=name), encoding="utf-8")
    (tmp_path / "hall" / "skillc.toml").write_text('name = "hall"\n', encoding="utf-8")
    (tmp_path / "hall" / "hall.ttl").write_text(SCENE, encoding="utf-8")
    return tmp_path


@contextmanager
def cell(folder: Path, server: str) -> Iterator[subprocess.Popen[str]]:
    """Start a cell that shares the world on a server; end it if it has not ended by itself."""
    command = (sys.executable, "-m", "skillc", "run", "hand_over", "--store", server, "--deadline", "60")
    environment = {**os.environ, "XDG_CACHE_HOME": str(folder / "cache")}
    process = subprocess.Popen(
        command, cwd=folder, env=environment, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT
    )
    try:
        yield process
    finally:
        process.kill()
        process.wait()


def wait_for_requests(proxy: Proxy, count: int) -> None:
    """Wait until so many more requests have come, which a cell that follows the world makes."""
    wanted = proxy.requests + count
    wait_until(lambda: proxy.requests >= wanted)


@pytest.mark.slow
def test_two_cells_hand_a_part_over_whatever_happens_to_the_server_and_to_one_of_them(cells: Path) -> None:
    kept = ox.Store()
    with ExitStack() as stack:
        with oxigraph(kept) as address:
            proxy = stack.enter_context(proxy_to(address))
            with cell(cells / "packing", proxy.address) as doomed:
                wait_for_requests(proxy, 12)
                doomed.send_signal(signal.SIGKILL)
            packing = stack.enter_context(cell(cells / "packing", proxy.address))
            wait_for_requests(proxy, 12)
            for fault in FAULTS:
                proxy.fail(fault, 1)
                wait_for_requests(proxy, 2)
        wait_for_requests(proxy, 2)
        with oxigraph(kept, urlsplit(address).port or 0):
            feeding = stack.enter_context(cell(cells / "feeding", address))
            told = feeding.communicate(timeout=LONG_S)[0] + packing.communicate(timeout=LONG_S)[0]
            store = open_store(address)
            written, facts = store.since(1), set(map(str, store.read().triples))
            store.close()
    assert (feeding.returncode, packing.returncode) == (0, 0), told
    assert [each.origin for each in written] == ["Feed", "Pack"]
    assert [each.author.rpartition(" ")[2] for each in written] == [str(feeding.pid), str(packing.pid)]
    assert [each for each in facts if "contain>" in each] == [
        "<http://example.org/lab#Box> <http://rvmi.aau.dk/ontologies/skiros.owl#contain> <http://example.org/lab#Load-1>"
    ]


@pytest.mark.parametrize("where", ["folder", "server"])
def test_others_hear_who_wrote(where: str, tmp_path: Path) -> None:
    with oxigraph() as address:
        place = address if where == "server" else str(tmp_path / "store")
        writing, reading = open_store(place, author="ann@lab, process 7"), open_store(place, author="bob")
        writer, reader = model_of(writing), model_of(reading)
        heard = list[str]()
        reader.subscribe(lambda event: heard.append(event.origin))
        assert writer.commit([assign("box", "weight", 5.0)], "Weigh").origin == "Weigh"
        reader.follow()
        reader.commit([assign("box", "weight", 6.0)], "Weigh again")
        assert heard == ["Weigh (ann@lab, process 7)", "Weigh again"]
        assert [each.author for each in reading.since(1)] == ["ann@lab, process 7", "bob"]
        writing.close()
        reading.close()


def test_an_author_is_a_process() -> None:
    assert describe_author().endswith(f"process {os.getpid()}") and "\n" not in describe_author()
