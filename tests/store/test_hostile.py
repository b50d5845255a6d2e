"""Stores that lie, and stores whose files were damaged: an error of one line, or the world as it was written."""

from __future__ import annotations

import json
import shutil
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from random import Random

import pytest

from skillc_runtime.store.disk import JOURNAL, DiskStore
from skillc_runtime.store.journal import LAST
from skillc_runtime.store.sparql import SparqlStore
from skillc_runtime.store.triples import all_triples
from skillc_runtime.world.state.transactions import ChangeEvent, StoreError
from store.actors import fill_a_full_disk
from store.processes import Actor
from store.worlds import facts_of, model_of
from world.lab import SCENE, assign, iri

BOX, WEIGHT, SHELF, CONTAIN = iri("box"), iri("weight"), iri("shelf"), iri("contain")
FACTS = "".join(f"{each} .\n" for each in all_triples(SCENE))
DAMAGED = 200


class Liar:
    """A server that answers what it is told to."""

    def __init__(self, log: str = "[]", facts: str = FACTS, number: str = "2") -> None:
        self._log = _rows({"n": number, "origin": "a stranger", "changes": log})
        self._facts, self._head = facts.encode("utf-8", "surrogatepass"), _rows({"n": "1", "beginning": ""})

    def __str__(self) -> str:
        return "http://liar"

    def query(self, text: str, accept: str) -> bytes:
        if text.startswith("CONSTRUCT"):
            return self._facts
        return self._log if "?origin" in text else self._head

    def update(self, text: str) -> None:
        return

    def close(self) -> None:
        return


def _rows(row: dict[str, str]) -> bytes:
    return json.dumps({"results": {"bindings": [{name: {"value": value} for name, value in row.items()}]}}).encode()


LOGS = {
    '[["AddRelation", 1, 2, 3]]': "log .* is damaged: .*the subject of a change of the kind AddRelation is invalid",
    '[["AddRelation", "a"]]': "log .* is damaged",
    '[["Nuke"]]': "log .* is damaged: .*Nuke",
    "[[]]": "log .* is damaged",
    "null": "log .* is damaged",
    "\x00": "log .* is damaged",
    "[" * 100_000: "log .* is damaged",
    f'[["SetProperty", "{BOX}", "{WEIGHT}", {"9" * 400}]]': "log .* is damaged: .*value",
    f'[["SetProperty", "{BOX}", "{WEIGHT}", 1e400]]': "log .* is damaged",
    f'[["SetProperty", "{BOX}", "{WEIGHT}", {{"vector": "up"}}]]': "log .* is damaged",
    f'[["AddIndividual", "{BOX}", 5]]': "log .* is damaged: .*types",
    f'[["SetProperty", "{BOX}", "{WEIGHT}", "heavy"]]': r"transaction 2 .* does not go with these skills: .*heavy",
    f'[["SetProperty", "{BOX}", "{WEIGHT}", [1, 2]]]': "does not go with these skills",
    f'[["SetProperty", "{BOX}", "http://p", 1]]': "does not go with these skills: there is no .* http://p",
    f'[["AddRelation", "{SHELF}", "http://r", "{BOX}"]]': "does not go with these skills: there is no .* http://r",
    f'[["AddRelation", "{SHELF}", "{CONTAIN}", "http://x"]]': "there is no individual http://x",
    f'[["AddRelation", "{SHELF}", "{CONTAIN}", "{SHELF}"]]': "is irreflexive|is asymmetric",
    f'[["AddIndividual", "{BOX}", ["http://C"]]]': "there is no such class",
}


@pytest.mark.parametrize("log", LOGS, ids=lambda log: log[:40])
def test_a_transaction_of_a_liar_is_refused_and_what_came_before_it_stays(log: str) -> None:
    model = model_of(SparqlStore(Liar(log), patience_s=0.0))
    before, heard = model.snapshot(), list[ChangeEvent]()
    model.subscribe(heard.append)
    with pytest.raises(StoreError, match=LOGS[log]) as caught:
        model.follow()
    assert "\n" not in str(caught.value) and model.snapshot() is before and model.sequence == 1 and not heard


def test_what_precedes_a_refused_transaction_is_heard(tmp_path: Path) -> None:
    store = DiskStore(tmp_path / "store")
    writer, reader = model_of(store), model_of(DiskStore(tmp_path / "store"))
    writer.commit([assign("box", "weight", 5.0)], "honest")
    event = writer.commit([assign("box", "weight", 6.0)], "honest too")
    store.append(ChangeEvent((assign("box", "weight", "heavy"),), "stranger", event.before, event.after), 3)
    heard = list[str]()
    reader.subscribe(lambda each: heard.append(each.origin))
    with pytest.raises(StoreError, match=r"transaction 4 .* does not go with these skills"):
        reader.follow()
    assert heard == ["honest", "honest too"] and reader.snapshot().value(BOX, WEIGHT) == 6.0


@pytest.mark.parametrize("number", ["-2", "2.0", "²", "9" * 5000, "", "3"])
def test_a_number_that_is_none_is_refused(number: str) -> None:
    model = model_of(SparqlStore(Liar("[]", number=number), patience_s=0.0))
    with pytest.raises(StoreError, match=r"invalid result|was reset by another process"):
        model.follow()
    assert model.sequence == 1


@pytest.mark.parametrize(
    "line",
    [
        "<a> <b>",
        "<a> <b> <c> .",
        "\x00",
        '<http://a> <http://b> "\ud800" .',
        "<< <http://a> <http://b> <http://c> >> <http://d> <http://e> .",
        "_:a <http://b> _:c .",
        "<http://a> <http://www.w3.org/1999/02/22-rdf-syntax-ns#type> <http://C> .",
        f'<{BOX}> <{WEIGHT}> "heavy" .',
        f'<{BOX}> <{WEIGHT}> "{"9" * 5000}"^^<http://www.w3.org/2001/XMLSchema#integer> .',
    ],
    ids=lambda line: line[:40],
)
def test_facts_of_a_liar_are_refused(line: str) -> None:
    with pytest.raises(StoreError, match=r"invalid result|does not go with these skills") as caught:
        model_of(SparqlStore(Liar(facts=FACTS + line + "\n"), patience_s=0.0))
    assert "\n" not in str(caught.value)


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """Yield a store as a process that died leaves it, with two compactions before."""
    folder = tmp_path_factory.mktemp("whole")
    for round_ in range(3):
        store = DiskStore(folder / "used")
        model = model_of(store)
        for number in range(4):
            model.commit([assign("box", "weight", 10.0 * round_ + number)])
        if round_ == 2:
            shutil.copytree(folder / "used", folder / "store")
        store.close()
    yield folder / "store"


def damage(place: Path, chance: Random) -> str:
    """Damage one of the files below a folder; return which and how."""
    file = chance.choice([each for each in sorted(place.rglob("*")) if each.is_file() and each.stat().st_size])
    content = bytearray(file.read_bytes())
    kind = chance.choice(("bit", "zeros", "noise", "cut", "tail", "empty", "gone"))
    at = chance.randrange(len(content))
    match kind:
        case "bit":
            content[at] ^= 1 << chance.randrange(8)
        case "zeros" | "noise":
            end = min(at + 200, len(content))
            content[at:end] = bytes(end - at) if kind == "zeros" else chance.randbytes(end - at)
        case "cut" | "empty":
            del content[at if kind == "cut" else 0 :]
        case "tail":
            content += chance.randbytes(40)
        case _:
            file.unlink()
            return f"{file.name} {kind}"
    file.write_bytes(content)
    return f"{file.name} {kind}"


@pytest.mark.slow
def test_a_damaged_file_is_told_or_does_not_matter(whole: Path, tmp_path: Path) -> None:
    expected, refused = facts_of(SCENE.with_changes([assign("box", "weight", 23.0)])), 0
    for seed in range(DAMAGED):
        place = tmp_path / str(seed)
        shutil.copytree(whole, place)
        told = f"{seed}: {damage(place, Random(seed))}"
        try:
            with closing(DiskStore(place)) as store:
                model = model_of(store)
                assert facts_of(model.snapshot()) == expected, told
                model.commit([assign("box", "weight", 99.0)])
            # A part that was not read until now may be damaged.
            with closing(DiskStore(place)) as store:
                assert model_of(store).snapshot().value(BOX, WEIGHT) == 99.0, told
        except StoreError as error:
            refused += 1
            assert "\n" not in str(error), told
        shutil.rmtree(place)
    assert DAMAGED // 4 < refused < DAMAGED


@pytest.mark.parametrize("length", [0, 0.5, None])
def test_a_journal_without_its_end_is_not_an_older_world(whole: Path, tmp_path: Path, length: float | None) -> None:
    place = tmp_path / "store"
    shutil.copytree(whole, place)
    journal = (place / JOURNAL).read_bytes()
    lines = journal.splitlines(keepends=True)
    if length is None:
        (place / JOURNAL).unlink()
    else:
        (place / JOURNAL).write_bytes(b"".join(lines[: int(len(lines) * length)]))
    kept = 9 + (2 if length else 0)
    with closing(DiskStore(place)) as store, pytest.raises(StoreError, match=f"ends after .* {kept}, but 13 were"):
        model_of(store)
    (place / JOURNAL).write_bytes(journal)
    with closing(DiskStore(place)) as store:
        assert model_of(store).snapshot().value(BOX, WEIGHT) == 23.0
    (place / JOURNAL).write_bytes(b"")
    (place / LAST).unlink()
    with closing(DiskStore(place)) as store:
        assert model_of(store).snapshot().value(BOX, WEIGHT) == 23.0


def test_facts_that_are_gone_are_not_an_empty_store(whole: Path, tmp_path: Path) -> None:
    place = tmp_path / "store"
    with closing(DiskStore(place)) as store:
        model_of(store)
    shutil.rmtree(place / "facts")
    with closing(DiskStore(place)) as store, pytest.raises(StoreError, match="ends after transaction 0, but 1 were"):
        model_of(store)
    with closing(DiskStore(place, reset=True)) as store:
        assert facts_of(model_of(store).snapshot()) == facts_of(SCENE)


def test_a_journal_that_is_shortened_under_a_user_is_told(tmp_path: Path) -> None:
    with closing(DiskStore(tmp_path / "store")) as store:
        model = model_of(store)
        model.commit([assign("box", "weight", 5.0)])
        (tmp_path / "store" / JOURNAL).write_bytes(b"")
        for attempt in (model.follow, lambda: model.commit([assign("box", "weight", 6.0)])):
            with pytest.raises(StoreError, match="was shortened while it was in use"):
                attempt()
        assert model.snapshot().value(BOX, WEIGHT) == 5.0


def test_a_disk_that_is_full_at_first_keeps_nothing_half(tmp_path: Path) -> None:
    writer = Actor(fill_a_full_disk, tmp_path / "store")
    (message,) = writer.told()
    assert writer.process.exitcode == 0 and "cannot be written" in message and "File too large" in message
    with closing(DiskStore(tmp_path / "store")) as store:
        assert facts_of(model_of(store).snapshot()) == facts_of(SCENE)
