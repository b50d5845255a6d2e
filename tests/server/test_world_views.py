"""The world of a running cell is searched, exported and drawn by the commands that do so with a scene."""

from __future__ import annotations

import json
from pathlib import Path
from xml.etree import ElementTree

import pytest

import skillc
from server.running import RunningServer
from server.test_client_commands import here, type_in  # noqa: F401

MOVED = ("lab:Goal skiros:contain lab:crate-4",)


@pytest.fixture
def moved(here: RunningServer) -> RunningServer:  # noqa: F811
    """A cell whose world is not that of its scene file any more."""
    here.put_back()
    assert type_in("scene", "edit", "--cell", "yard", "--why", "carried by hand", *MOVED).exit_code == 0
    return here


def test_what_is_searched_is_found_with_how_it_is_known(moved: RunningServer) -> None:
    found = type_in("world", "--cell", "yard", "--search", "goal")
    assert found.exit_code == 0 and "lab:Goal contain lab:crate-4  (admin: carried by hand)" in found.stdout
    assert not any(line.startswith("lab:Start ") for line in found.stdout.splitlines())
    several = type_in("world", "--cell", "yard", "--show", "lab:Goal", "--show", "lab:Cart-1", "--json")
    subjects = {
        (each["fact"].get("subject") or each["fact"]["individual"])["label"] for each in json.loads(several.stdout)
    }
    assert subjects == {"lab:Goal", "lab:Cart-1"}
    nothing = type_in("world", "--cell", "yard", "--search", "zebra")
    assert nothing.exit_code == 1 and "no individual matches `zebra`" in nothing.stderr
    with skillc.connect(f"http://127.0.0.1:{moved.port}", moved.token) as connected:
        assert {
            each.fact.subject.label for each in connected.cell().facts(search="goal") if hasattr(each.fact, "subject")
        } == {"lab:Goal"}


@pytest.mark.parametrize("form", ["turtle", "rdfxml", "jsonld", "ntriples", "trig"])
def test_an_export_is_the_world_as_it_is_now(moved: RunningServer, tmp_path: Path, form: str) -> None:
    file = tmp_path / "world.rdf"
    assert type_in("world", "--cell", "yard", "--export", form, "-o", str(file)).stdout == f"{file}\n"
    shown = type_in("world", str(file), "--library", str(moved.folder), "--show", "lab:Goal")
    assert "crate-4" in shown.stdout, shown.stderr


def test_pictures_are_drawn_by_the_server(moved: RunningServer, tmp_path: Path) -> None:
    picture = tmp_path / "yard.svg"
    assert type_in("world", "--cell", "yard", "--graph", str(picture)).stdout == f"{picture}\n"
    assert "crate-4" in "".join(ElementTree.parse(picture).getroot().itertext())
    shown = type_in("scene", "show", "--cell", "yard", "--out", str(tmp_path / "shown"))
    assert shown.exit_code == 0 and shown.stdout.split()[:3] == ["thing", "class", "stated"]
    assert ElementTree.parse(tmp_path / "shown" / "yard.svg").getroot().tag.endswith("svg")


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (("world", "--cell", "yard", "--diff", "yard.ttl"), "--diff cannot be used with a cell of a server"),
        (("world", "yard.ttl", "--cell", "yard"), "SCENE cannot be named with a cell of a server"),
        (("scene", "show", "yard.ttl", "--cell", "yard"), "SCENE cannot be named with a cell of a server"),
        (("scene", "move", "--cell", "yard", "lab:Goal"), "`skillc scene move` writes a file"),
        (("scene", "add", "--server", "http://127.0.0.1:1", "x", "Box"), "changes the world of a cell"),
        (("scene", "remove", "--cell", "yard", "lab:Goal"), "`skillc scene edit --cell NAME --why TEXT EDIT...`"),
        (("scene", "import", "--cell", "yard", "a.urdf"), "`skillc scene import` writes a file"),
        (("scene", "new", "--cell", "yard"), "`skillc scene new` writes a file"),
    ],
    ids=lambda each: "-".join(each[:2]) if isinstance(each, tuple) else "",
)
def test_what_makes_no_sense_for_a_cell_is_refused_with_a_sentence(words: tuple[str, ...], why: str) -> None:
    refused = type_in(*words)
    assert refused.exit_code == 2 and why in " ".join(refused.stderr.split())
