"""A library is imported by others: from a folder, an installed package, an entry point; a lock notices a change."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import pytest

from projects.folders import call, checked, names, write_project

HANDLING = """\
import "terms.skill"

## Say that a part is ready.
skill Prepare {
    in   part: Blank
    post ready: part.isReady == true
    duration 1 s
}

impl plain of Prepare { do seq {
    wait 1 s
    apply ready
} }
"""
TERMS = "use skiros\nclass Blank < Product\nproperty isReady(Blank): Bool\n"
USER = """\
prefix lab: <http://example.org/lab#>
import "handing/prepare.skill"
import "handing/terms.skill"

class Bolt < Blank

task get_ready {
    scene "cell.ttl"
    do    Prepare(part: lab:Bolt-1)
}
"""
SCENE = """\
@prefix lab: <http://example.org/lab#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
@prefix skillc: <https://w3id.org/skillc/core#> .
@prefix handing: <https://example.org/handing#> .
@prefix mine: <https://w3id.org/skillc/library/mine#> .
lab:Scene-1 a skiros:Scene ; skiros:contain lab:Cell .
lab:Cell a skillc:Workstation ; skiros:FrameId "cell" ; skillc:on lab:Scene-1 ; skiros:contain lab:Bolt-1 .
lab:Bolt-1 a mine:Bolt ; handing:isReady false .
"""
WAYS = ['{ path = "../handing" }', '{ package = "acme_handing" }', '{ entry-point = "acme" }']


@pytest.fixture
def handing(tmp_path: Path) -> Path:
    manifest = 'name = "handing"\nversion = "1.2.0"\nnamespace = "https://example.org/handing#"\n'
    folder = write_project(tmp_path / "handing", manifest, TERMS)
    (folder / "tasks.skill").rename(folder / "terms.skill")
    (folder / "prepare.skill").write_text(HANDLING, "utf-8")
    return folder


@pytest.fixture
def installed(handing: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Install the library as a package, with an entry point, in a folder that Python imports from."""
    place = tmp_path / "site"
    information = place / "acme_handing-1.2.0.dist-info"
    information.mkdir(parents=True)
    (information / "METADATA").write_text("Metadata-Version: 2.1\nName: acme-handing\nVersion: 1.2.0\n", "utf-8")
    (information / "entry_points.txt").write_text("[skillc.libraries]\nacme = acme_handing\n", "utf-8")
    handing.rename(place / "acme_handing")
    (place / "acme_handing/__init__.py").touch()
    monkeypatch.syspath_prepend(str(place))
    return place / "acme_handing"


def write_user(tmp_path: Path, way: str) -> Path:
    folder = write_project(tmp_path / "user", f'name = "mine"\n[dependencies]\nhanding = {way}\n', USER)
    (folder / "cell.ttl").write_text(SCENE, "utf-8")
    return folder


@pytest.mark.parametrize("way", WAYS)
def test_a_library_is_used_where_it_is(way: str, request: pytest.FixtureRequest, tmp_path: Path) -> None:
    request.getfixturevalue("handing" if "path" in way else "installed")
    user = write_user(tmp_path, way)
    assert checked(user, "--scene", "cell.ttl") == []
    planned = call(user, "plan", "--scene", "cell.ttl", "--goal", "lab:Bolt-1.isReady == true", "--json")
    assert [step["skill"] for step in json.loads(planned.stdout)["plan"]] == ["Prepare"], planned.output
    assert call(user, "compile", "-o", "out").exit_code == 0
    classes = json.loads((user / "out/library.json").read_text())["vocabulary"]["classes"]
    assert "https://example.org/handing#Blank" in classes and "acme_handing" not in sys.modules


def test_an_error_in_a_library_is_shown_in_its_file(handing: Path, tmp_path: Path) -> None:
    user = write_user(tmp_path, WAYS[0])
    (handing / "terms.skill").write_text(TERMS.replace("Product", "Prodct"), "utf-8")
    (found,) = (each for each in checked(user) if each["path"].endswith(".skill"))
    assert found["path"].endswith("handing/terms.skill") and found["name"] == "unknown-class"


def test_a_misspelt_import_names_the_file_of_the_library(handing: Path, tmp_path: Path) -> None:
    user = write_user(tmp_path, WAYS[0])
    (user / "tasks.skill").write_text(USER.replace("handing/prepare", "handing/prepair"), "utf-8")
    (found,) = checked(user)
    assert found["name"] == "unknown-import" and "`handing/prepare.skill`" in found["help"]


@pytest.mark.parametrize(
    ("manifest", "words"),
    [
        ('name = "hander"\n', "is called `hander`"),
        ('name = "handing"\n[dependencies]\nmine = { path = "../user" }\n', "circle: mine needs handing needs mine"),
        ('name = "handing"\n[dependencies]\nmore = { path = "../more" }\n', "there is no folder"),
        ("name = 1\n", "expected a text"),
    ],
)
def test_a_library_that_cannot_be_used_is_one_diagnostic(
    manifest: str, words: str, handing: Path, tmp_path: Path
) -> None:
    user = write_user(tmp_path, WAYS[0])
    (handing / "skillc.toml").write_text(manifest, "utf-8")
    (found,) = checked(user)
    assert words in found["message"]


def test_a_library_without_manifest_is_no_dependency(handing: Path, tmp_path: Path) -> None:
    user = write_user(tmp_path, WAYS[0])
    (handing / "skillc.toml").unlink()
    assert names(checked(user)) == [("unknown-library", 3)]


def test_libraries_of_libraries_can_be_imported(handing: Path, tmp_path: Path) -> None:
    middle = 'name = "middle"\n[dependencies]\nhanding = { path = "../handing" }\n'
    write_project(tmp_path / "middle", middle, 'import "handing/terms.skill"\nclass Nut < Blank\n')
    user = write_user(tmp_path, WAYS[0])
    (user / "skillc.toml").write_text('name = "mine"\n[dependencies]\nmiddle = { path = "../middle" }\n', "utf-8")
    text = USER.replace("\n\nclass", '\nimport "middle/tasks.skill"\n\nclass Wheel < Nut\nclass')
    (user / "tasks.skill").write_text(text, "utf-8")
    assert checked(user) == []


def test_a_lock_notices_each_change(handing: Path, tmp_path: Path) -> None:
    user = write_user(tmp_path, WAYS[0])
    (user / "sub").mkdir()
    assert call(user / "sub", "lock").exit_code == 0
    assert checked(user) == []
    (handing / "terms.skill").write_text(f"{TERMS}class Nut < Blank\n", "utf-8")
    (found,) = checked(user)
    assert (found["name"], found["line"]) == ("outdated-lock", 3) and "changed since it was locked" in found["message"]
    manifest = (handing / "skillc.toml").read_text("utf-8")
    (handing / "skillc.toml").write_text(manifest.replace("1.2.0", "1.3.0"), "utf-8")
    assert "version 1.3.0, and skillc.lock has 1.2.0" in checked(user)[0]["message"]
    assert call(user, "lock").exit_code == 0
    assert checked(user) == []
    (user / "skillc.lock").write_text("[handing", "utf-8")
    assert "cannot be read" in checked(user)[0]["message"]


def test_tasks_of_a_library_are_listed_and_planned(handing: Path, tmp_path: Path) -> None:
    user = write_user(tmp_path, WAYS[0])
    (handing / "cell.ttl").write_text(SCENE.replace("mine:Bolt", "handing:Blank"), "utf-8")
    task = 'task ready {\n    scene "cell.ttl"\n    goal  lab:Bolt-1.isReady == true\n}\n'
    header = 'prefix lab: <http://example.org/lab#>\nimport "prepare.skill"\nimport "terms.skill"\n'
    (handing / "tasks.skill").write_text(f"{header}{task}", "utf-8")
    assert checked(handing) == []
    listed = [each["name"] for each in json.loads(call(user, "tasks", "--json").stdout)]
    assert "handing:ready" in listed
    assert call(user, "plan", "handing:ready").exit_code == 0
