"""What `skillc check` remembers: nothing is told that does not hold any more, and nothing is done twice."""

import json
import os
import subprocess
import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from click.testing import CliRunner

from skillc.cli.main import skillc
from skillc.services.check import library_checks
from skillc.services.library import answer_store
from skillc_dsl.cache import load, store
from skillc_ontology import catalogue

HEAVY = ("lark", "rich", "pyoxigraph", "rdflib", "numpy", "mujoco", "jinja2", "skillc_compiler.pipeline")
TASK = """
prefix lab: <http://example.org/lab#>
import "wiping/wipe.skill"
import "mine.skill"
task rest {
    scene "scene.ttl"
    do    Wipe(surface: lab:Table-1)
}
"""
MINE = """
use skiros
class Board < Product
skill Look {
    in   board: Board
    pre  board has FrameId
    noplan
}
impl looking of Look { run python "lab_primitives.look:Look" }
"""

LOOK = """
class Look:
    def __init__(self, cell, board): ...
    def tick(self): return SUCCESS
"""


@pytest.fixture
def own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return the folder of this test's cache, which nothing but the library and what it names invalidates."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setattr(answer_store, "installation_digest", lambda: b"this one")
    return tmp_path / "cache" / "skillc" / "check"


@pytest.fixture
def library(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a library of two files, beside a scene and the Python that it names."""
    folder, python = tmp_path / "lab", tmp_path / "python" / "lab_primitives"
    folder.mkdir()
    python.mkdir(parents=True)
    (folder / "tasks.skill").write_text(TASK, encoding="utf-8")
    (folder / "mine.skill").write_text(MINE, encoding="utf-8")
    (folder / "scene.ttl").write_text(catalogue.scene_path("iiwa_table").read_text("utf-8"), encoding="utf-8")
    (python / "__init__.py").touch()
    (python / "look.py").write_text(LOOK, encoding="utf-8")
    monkeypatch.syspath_prepend(str(python.parent))
    return folder


def check(library: Path, *options: str) -> list[dict[str, object]]:
    result = CliRunner().invoke(skillc, ["check", str(library), "--json", *options])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    found: list[dict[str, object]] = json.loads(result.stdout)
    return found


def replaced(file: Path, old: str, new: str) -> None:
    text = file.read_text("utf-8")
    assert old in text
    file.write_text(text.replace(old, new), encoding="utf-8")


def put(file: Path, text: str) -> None:
    file.write_text(text, encoding="utf-8")


CHANGES: dict[str, Callable[[Path], None]] = {
    "a file": lambda lab: replaced(lab / "tasks.skill", "Wipe(", "Wype("),
    "an imported file": lambda lab: replaced(lab / "mine.skill", "< Product", "< Prodoct"),
    "a new file": lambda lab: put(lab / "new.skill", "class A < Nothing\n"),
    "a file that goes": lambda lab: (lab / "mine.skill").unlink(),
    "the scene": lambda lab: replaced(lab / "scene.ttl", "lab:Table-1", "lab:Table-2"),
    "the scene that goes": lambda lab: (lab / "scene.ttl").unlink(),
    "what Python returns": lambda lab: replaced(lab.parent / "python/lab_primitives/look.py", "SUCCESS", "RUNNING"),
    "the Python": lambda lab: replaced(lab.parent / "python/lab_primitives/look.py", "board", "table"),
}


@pytest.mark.slow
@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES.keys())
def test_whatever_changes_is_seen(library: Path, own: Path, change: Callable[[Path], None]) -> None:
    before = check(library)
    assert check(library) == before
    change(library)
    after = check(library)
    assert after == check(library, "--no-cache")
    assert after != before


def test_what_has_not_changed_is_not_checked_again(library: Path, own: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    before = check(library)
    assert len(list(own.iterdir())) == 1
    monkeypatch.setattr(library_checks, "check_whole", lambda *_: pytest.fail("checked again"))
    assert check(library) == before


def test_nothing_is_remembered_without_the_cache(library: Path, own: Path) -> None:
    check(library, "--no-cache")
    assert not own.exists()


@pytest.mark.parametrize("damage", [b"", b"short", b"x" * 200])
def test_a_damaged_entry_is_none(library: Path, own: Path, damage: bytes) -> None:
    before = check(library)
    (entry,) = own.iterdir()
    entry.write_bytes(damage)
    assert check(library) == before
    assert entry.read_bytes() != damage


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="everything is writable for root")
def test_a_folder_that_cannot_be_written_only_costs_time(library: Path, own: Path) -> None:
    own.parent.parent.mkdir(parents=True)
    own.parent.parent.chmod(0o500)
    assert check(library) == check(library, "--no-cache")


def test_a_cache_that_is_no_folder_only_costs_time(library: Path, own: Path) -> None:
    own.parent.parent.parent.mkdir(parents=True, exist_ok=True)
    own.parent.parent.write_text("a file", encoding="utf-8")
    assert check(library) == check(library, "--no-cache")


def test_writers_and_readers_at_once_see_all_or_nothing(tmp_path: Path) -> None:
    path, bodies = tmp_path / "x", [bytes([number]) * 50_000 for number in range(8)]
    with ThreadPoolExecutor(8) as pool:
        seen = [found for turn in range(20) for found in pool.map(lambda body: store(path, body) or load(path), bodies)]
    assert len(seen) == 160
    assert all(found in bodies for found in seen)
    assert [file.name for file in tmp_path.iterdir()] == ["x"]


def test_another_state_of_the_installation_is_another_digest(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    package = tmp_path / "some_package"
    (package / "inner").mkdir(parents=True)
    (package / "__init__.py").touch()
    module = package / "inner" / "module.py"
    module.write_text("a = 1\n", encoding="utf-8")
    monkeypatch.syspath_prepend(str(tmp_path))
    monkeypatch.setattr(answer_store, "PACKAGES", ("some_package",))
    states = [tuple(answer_store.describe_installation())]
    assert tuple(answer_store.describe_installation()) == states[0]
    module.write_text("a = 12\n", encoding="utf-8")
    states.append(tuple(answer_store.describe_installation()))
    (package / "inner" / "added.py").touch()
    states.append(tuple(answer_store.describe_installation()))
    (tmp_path / "another_package").mkdir()
    states.append(tuple(answer_store.describe_installation()))
    assert len(set(states)) == 4


@pytest.mark.slow
def test_nothing_heavy_is_imported_for_what_is_remembered(library: Path, own_cache: Path) -> None:
    program = f"""
import sys
from skillc.cli.main import main
try:
    main(["check", {str(library)!r}, "--format", sys.argv[1]])
except SystemExit:
    print(*sys.modules, file=sys.stderr)
"""
    runs = [
        subprocess.run([sys.executable, "-c", program, form], capture_output=True, text=True, check=True)
        for form in ("concise", "full")
    ]
    cold, warm = (set(run.stderr.split()) & set(HEAVY) for run in runs)
    assert {"pyoxigraph", "skillc_compiler.pipeline"} <= cold
    assert warm == set()


@pytest.mark.slow
def test_every_file_that_is_read_counts(library: Path) -> None:
    """A check opens no file but those of skillc and Python and those whose content is part of the digest."""
    program = f"""
import sys
opened = set()
sys.addaudithook(lambda event, arguments: opened.add(str(arguments[0])) if event == "open" else None)
from pathlib import Path
from skillc.services.check import library_checks
from skillc.services.library import check_inputs
from skillc.services.library import files as library_files
library = library_files.find_library(Path({str(library)!r}))
opened.clear()
check_inputs.compute_digest(library, None)
counted = set(opened) | set(map(str, library.places.values()))
opened.clear()
library_checks.check_library(library, None)
print(*sorted(opened - counted), sep="\\n")
print(*counted, sep="\\n", file=sys.stderr)
"""
    run = subprocess.run(
        [sys.executable, "-c", program],
        capture_output=True,
        text=True,
        check=True,
        env={**os.environ, "PYTHONPATH": os.pathsep.join((str(library.parent / "python"), *filter(None, sys.path)))},
    )
    assert f"{library}/scene.ttl" in run.stderr
    assert [line for line in run.stdout.splitlines() if line.startswith(str(library.parent))] == []
