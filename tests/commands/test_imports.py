"""What a library of one's own may import: files of its own, of `std`, and of the other libraries that ship."""

from pathlib import Path

from click.testing import CliRunner

from skillc.cli.main import skillc
from skillc.services.library.files import SHIPPED

WORK = """
use skillc, contact
{imports}
skill Feel {{
    in   arm:    CompliantArm
    in   socket: Socket
    shares arm
    noplan
}}
impl deep of Feel {{
    do SinkBelow(arm, target: socket.pose, along: socket.axis, depth: 1 mm)
}}
"""


def write(library: Path, *files: str) -> None:
    """Write a library that imports some files, of which one has `SinkBelow`."""
    text = WORK.format(imports="\n".join(f'import "{file}"' for file in files))
    (library / "mine.skill").write_text(text, encoding="utf-8")


def errors(path: Path) -> list[str]:
    """What `skillc check` finds that is wrong."""
    lines = CliRunner().invoke(skillc, ["check", str(path), "--format", "concise"]).stdout.splitlines()
    return [line for line in lines if ": error[" in line]


def test_files_of_another_shipped_library_find_what_stands_beside_them_there(tmp_path: Path) -> None:
    files = sorted(file.name for file in (SHIPPED / "contact").glob("*.skill") if file.name != "tasks.skill")
    assert "insert.skill" in files
    write(tmp_path, *(f"contact/{file}" for file in files))
    assert errors(tmp_path) == []
    assert errors(tmp_path / "mine.skill") == []


def test_files_of_that_name_in_ones_own_library_are_not_taken_for_them(tmp_path: Path) -> None:
    write(tmp_path, "contact/insert.skill")
    (tmp_path / "fixtures.skill").write_text("use contact\nclass Shelf < Socket\n", encoding="utf-8")
    assert errors(tmp_path) == []


def test_what_stands_nowhere_is_told(tmp_path: Path) -> None:
    write(tmp_path, "contact/inserts.skill", "contact/insert.skill")
    (found,) = errors(tmp_path)
    assert 'there is no file "contact/inserts.skill"' in found
