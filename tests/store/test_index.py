"""The index beside the facts of a store: the same world, or none; never that of other facts, nor a damaged one."""

from __future__ import annotations

from pathlib import Path
from random import Random

import msgspec
import pytest
from click.testing import CliRunner

from skillc.cli.main import skillc
from skillc.services.scene import stores
from skillc_runtime.store import world_index
from skillc_runtime.store.disk import DiskStore
from skillc_runtime.store.http import find_endpoint
from skillc_runtime.store.sparql import SparqlStore, digest_lines
from skillc_runtime.store.sparql_texts import WORLD
from skillc_runtime.store.world_index import IndexPlace, read_index, write_index
from store.servers import oxigraph
from store.worlds import facts_of, filling, model_of
from world.lab import SCENE, VOCABULARY, assign


@pytest.fixture(autouse=True)
def small(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(world_index, "LEAST", 1)


def kept(folder: Path) -> IndexPlace:
    """Return where the index of a new store is, which is there."""
    store = DiskStore(folder)
    store.append(filling(), 0)
    place = store.find_index()
    assert place is not None
    write_index(place, VOCABULARY, SCENE)
    store.close()
    assert place.file.stat().st_size > 1_000
    return place


def test_the_world_of_an_index_is_that_of_the_facts(tmp_path: Path) -> None:
    found = read_index(kept(tmp_path / "lab"), VOCABULARY)
    assert found is not None and facts_of(found) == facts_of(SCENE)
    assert found.vocabulary.prefixes == SCENE.vocabulary.prefixes
    closed = {iri: set(links.pairs()) for iri, links in SCENE.facts.items()}
    assert {iri: set(links.pairs()) for iri, links in found.facts.items()} == closed and any(closed.values())
    assert {one: found.types(one) for one in found.individuals} == {one: SCENE.types(one) for one in SCENE.individuals}


def test_a_later_transaction_another_vocabulary_and_another_store_make_it_void(tmp_path: Path) -> None:
    place = kept(tmp_path / "lab")
    other = msgspec.structs.replace(VOCABULARY, prefixes={**VOCABULARY.prefixes, "x": "http://e/x#"})
    assert read_index(place, VOCABULARY) is not None and read_index(place, other) is None
    again = DiskStore(tmp_path / "lab")
    assert again.find_index() == place
    model_of(again).commit([assign("box", "weight", 3.5)], "test")
    assert again.find_index() is None
    again.close()
    later = DiskStore(tmp_path / "lab")
    moved = later.find_index()
    assert moved is not None and moved.sequence == 2 and read_index(moved, VOCABULARY) is None
    later.close()
    emptied = DiskStore(tmp_path / "lab", reset=True)
    assert emptied.find_index() is None
    emptied.append(filling(), 0)
    new = emptied.find_index()
    assert new is not None and new.sequence == 1 and read_index(new, VOCABULARY) is None
    emptied.close()


def test_two_hundred_damaged_indexes_are_as_none(tmp_path: Path) -> None:
    place = kept(tmp_path / "lab")
    whole, chance, tried = place.file.read_bytes(), Random(42), 0
    for _ in range(200):
        at, kind = chance.randrange(len(whole)), chance.randrange(3)
        changed = bytes([whole[at] ^ chance.randint(1, 255)])
        damaged = (whole[:at], whole[:at] + changed + whole[at + 1 :], whole[:at] + changed + whole[at:])[kind]
        place.file.write_bytes(damaged)
        assert read_index(place, VOCABULARY) is None
        tried += 1
    place.file.write_bytes(b"")
    assert read_index(place, VOCABULARY) is None and tried == 200


def test_a_folder_that_cannot_be_written_to_is_no_error(tmp_path: Path) -> None:
    place = kept(tmp_path / "lab")._replace(file=tmp_path / "gone" / "index")
    write_index(place, VOCABULARY, SCENE)
    assert read_index(place, VOCABULARY) is None


def test_a_command_opens_a_store_by_its_index(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)

    def ask(*arguments: str) -> str:
        found = CliRunner().invoke(skillc, ["world", *arguments, "--store", "lab", "--json"])
        assert found.exit_code == 0, found.stderr
        return found.stdout

    filled = ask("panda_desk")
    with monkeypatch.context() as patch:
        patch.setattr(stores, "build_world", None)
        assert ask() == filled
    Path("lab/index").unlink()
    assert ask() == filled and Path("lab/index").is_file()


def test_the_index_of_a_server_counts_for_its_present_facts_alone(tmp_path: Path) -> None:
    with oxigraph() as address:

        def find() -> IndexPlace | None:
            store = SparqlStore(find_endpoint(address), index=tmp_path / "world")
            place = store.find_index()
            assert place is None or facts_of(model_of(store).snapshot()), "what was fetched is read"
            store.close()
            return place

        assert find() is None
        writer = SparqlStore(find_endpoint(address))
        writer.append(filling(), 0)
        place = find()
        assert place is not None and place == find()
        write_index(place, VOCABULARY, SCENE)
        found = read_index(place, VOCABULARY)
        assert found is not None and facts_of(found) == facts_of(SCENE)
        model_of(writer).commit([assign("box", "weight", 3.5)], "test")
        later = find()
        assert later is not None and later.sequence == 2 and read_index(later, VOCABULARY) is None
        write_index(later, VOCABULARY, model_of(writer).snapshot())
        writer.close()
        other = find_endpoint(address)
        other.update(STRANGERS)
        changed = find()
        assert changed is not None and changed.sequence == 2, "somebody else left no entry in the log"
        assert read_index(later, VOCABULARY) is not None and read_index(changed, VOCABULARY) is None
        other.close()


STRANGERS = f"""DELETE {{ GRAPH {WORLD} {{ ?s ?p ?o }} }} INSERT {{ GRAPH {WORLD} {{ ?s ?p 4.5e0 }} }}
WHERE {{ GRAPH {WORLD} {{ ?s ?p ?o . FILTER (isNumeric(?o) && ?o = 3.5) }} }}"""
"""What another tool changes: one number for one of the same length."""


def test_a_digest_of_lines_knows_no_order_and_each_change() -> None:
    one = digest_lines(b"<a> <b> <c> .\n<d> <b> <e> .\n")
    assert one == digest_lines(b"<d> <b> <e> .\r\n\n<a> <b> <c> .")
    swapped, half = digest_lines(b"<a> <b> <e> .\n<d> <b> <c> .\n"), digest_lines(b"<a> <b> <c> .\n")
    assert len({one, swapped, half, digest_lines(b"")}) == 4


def test_a_large_world_on_a_server_is_opened_from_its_index(own_cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with oxigraph() as address:
        for first in (True, False):
            opened = CliRunner().invoke(skillc, ["world", "panda_desk", "--store", address, "--show", "lab:Desk-1"])
            assert "lab:Desk-1" in opened.stdout, opened.output
            assert ("filled" in opened.stderr) == first or "the world after 1 transaction" in opened.stderr
            monkeypatch.setattr(stores, "build_world", lambda *given: pytest.fail("the world is built again"))
        assert len([*(own_cache / "worlds").iterdir()]) == 1
