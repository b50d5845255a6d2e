"""What `skillc check` takes from a folder: its library or those below, Python beside it, the scene that is named."""

from pathlib import Path

import pytest
from test_check import check, names

TERMS = "use skiros\nclass Board < Product\n"
STEP = """use skiros
skill Fetch { in board: Product in self: Product noplan }
impl by_hand of Fetch { run python "own_steps_of_check:Fetch" }
"""
CLASS = "from skillc.primitives import Primitive\nclass Fetch(Primitive):\n    def tick(self): ...\n"
TASKS = """use wiping
import "wiping/wipe.skill"
prefix lab: <http://example.org/lab#>
task here { scene "iiwa_table.ttl" goal lab:Table-1.isClean == true }
task there { scene "nowhere.ttl" goal lab:Table-9.isClean == true }
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def write(folder: Path, **files: str) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in files.items():
        folder.joinpath(name.replace("__", ".")).write_text(text, encoding="utf-8")


def test_a_folder_of_libraries_is_no_library(folder: Path) -> None:
    write(folder / "one", terms__skill=TERMS)
    write(folder / "two" / "deeper", terms__skill=TERMS)
    write(folder / "three", terms__skill=TERMS, skillc__toml='name = "three"\n')
    write(folder / "three" / "env", pyvenv__cfg="", broken__skill="skill {")
    assert names(check("--json")) == []
    write(folder, own__skill=TERMS)  # the folder is a library now, to which all below but the project belongs
    assert names(check("--json")) == ["duplicate-declaration", "duplicate-declaration"]


def test_python_beside_a_library_needs_no_manifest(folder: Path) -> None:
    write(folder, fetch__skill=STEP, own_steps_of_check__py=CLASS)
    found = check(".", "--format", "full").stdout
    assert "wrong-python-parameters" in found and "missing-python" not in found
    assert "a constructor has the object itself as `self`: give the parameter another name" in found


def test_a_scene_that_is_named_is_the_only_one(folder: Path) -> None:
    write(folder, tasks__skill=TASKS)
    assert "unknown-scene" in names(check(".", "--json"))
    assert not {"unknown-scene", "unknown-individual"} & {*names(check(".", "--scene", "iiwa_table.ttl", "--json"))}


def test_a_skill_that_is_not_imported_names_its_file(folder: Path) -> None:
    write(folder / "sub", other__skill="use skiros\nskill Look { in at: Product noplan }\n")
    write(folder, fetch__skill="use skiros\nskill Fetch { in at: Product noplan }\nimpl a of Fetch { do Look(at) }\n")
    assert 'write `import "sub/other.skill"` at the top' in check(".").stdout
