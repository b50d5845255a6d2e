"""`skillc check --fix` and `--diff`: what is written, what is not, and that nothing is lost."""

import errno
import os
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import NoReturn

import pytest
from click.testing import CliRunner, Result

from skillc.cli.main import skillc
from skillc_ontology import catalogue

BROKEN = """use rparts
skill Rest {
    in arm:ArmDevice
    in hand:GripperEffector
    noplan
}
# allow unused-let: left over
impl resting of Rest { run python "skillc.primitives:StandIn" }
"""
FIXED = BROKEN.replace("arm:", "arm: ").replace("hand:", "hand: ").replace("# allow unused-let: left over\n", "")
GUESSED = FIXED.replace("ArmDevice", "ArmDevise")


@pytest.fixture
def library(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "lab"
    folder.mkdir()
    (folder / "rest.skill").write_text(BROKEN, encoding="utf-8")
    monkeypatch.chdir(folder)
    return folder


def check(*arguments: str, text: str | bytes | None = None) -> Result:
    result = CliRunner().invoke(skillc, ["check", *arguments], input=text)
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


def test_all_safe_fixes_are_applied_until_none_is_left(library: Path) -> None:
    result = check("--fix")
    assert (library / "rest.skill").read_text("utf-8") == FIXED
    assert (result.exit_code, result.stdout) == (0, "")
    assert result.stderr == "fixed 3 problems in 1 file\nno problems\n"
    assert check("--fix").stderr == "fixed 0 problems\nno problems\n"


def test_a_relation_that_is_called_like_a_word_of_the_language_gets_its_prefix(library: Path) -> None:
    head = "use skiros\nprefix shop: <http://example.org/shop#>\nrelation shop:pause(Product, Product)\n"
    skill = "skill Rest {{ in this: Product  in other: Product  pre this {}pause other  pause never  noplan }}\n"
    impl = 'impl resting of Rest { run python "skillc.primitives:StandIn" }\n'
    (library / "rest.skill").write_text(head + skill.format("") + impl, encoding="utf-8")
    assert check("--fix").stderr == "fixed 1 problem in 1 file\nno problems\n"
    assert (library / "rest.skill").read_text("utf-8") == head + skill.format("shop:") + impl


def test_a_diff_writes_nothing_and_can_be_applied_with_patch(library: Path) -> None:
    file = library / "rest.skill"
    file.write_text(BROKEN.rstrip("\n"), encoding="utf-8")
    result = check("--diff")
    assert result.exit_code == 1
    assert result.stderr == "3 problems can be fixed\n"
    assert file.read_text("utf-8") == BROKEN.rstrip("\n")
    subprocess.run(["patch", "-p0"], input=result.stdout, text=True, check=True, capture_output=True)
    assert file.read_text("utf-8") == FIXED.rstrip("\n")
    assert (check("--diff").exit_code, check("--diff").stdout) == (0, "")


def test_guesses_are_applied_only_when_asked_for(library: Path) -> None:
    file = library / "rest.skill"
    file.write_text(GUESSED, encoding="utf-8")
    assert check("--fix").exit_code == 1
    assert file.read_text("utf-8") == GUESSED
    assert check("--fix", "--unsafe-fixes").exit_code == 0
    assert file.read_text("utf-8") == FIXED


CARRYING = """use skiros

skill Take {
    in    part: Product
    in    to:   Location
    infer from: Location
    pre   from != to
    pre   from contain part
    post  there: to contain part
    post  gone: not from contain part
}

impl by_hand of Take {
    do seq {
        wait 1 s
        apply gone, there
    }
}

skill Bring {
    in    part: Product
    in    to:   Location
    infer from: Location
    pre   from != to
    pre   from contain part
    post not from contain part
    post to contain part
}

impl at_once of Bring { do Take(part: part, to: to) }
"""


@pytest.mark.parametrize(
    ("right", "wrong"),
    [
        ("1 s\n", "1\n"),
        ("Take(part: part, to: to)", "Take(part: part)"),
        ("Take(part: part, to: to)", "Take()"),
        ("    post to contain part\n", ""),
        ("    post not from contain part\n    post to contain part\n", ""),
        ("use skiros\n\n", ""),
    ],
)
def test_what_is_missing_is_written_where_it_belongs(library: Path, right: str, wrong: str) -> None:
    file = library / "rest.skill"
    assert right in CARRYING
    file.write_text(CARRYING.replace(right, wrong), encoding="utf-8")
    assert "error" in check().stdout
    check("--fix", "--unsafe-fixes")
    assert file.read_text("utf-8") == CARRYING


def test_a_fixed_standard_input_goes_to_the_standard_output(library: Path) -> None:
    result = check("-", "--fix", text=GUESSED + "# allow unused-let: no\nskill")
    assert result.exit_code == 1
    assert result.stdout == GUESSED + "# allow unused-let: no\nskill"
    assert "unknown-class" in result.stderr
    assert check("-", "--fix", text=BROKEN).stdout == FIXED


def test_permissions_line_ends_marks_and_links_are_kept(library: Path) -> None:
    file, link = library / "rest.skill", library / "linked.skill"
    file.write_bytes(b"\xef\xbb\xbf" + BROKEN.replace("\n", "\r\n").encode())
    file.chmod(0o640)
    file.rename(library.parent / "real.skill")
    link.symlink_to("../real.skill")
    assert check("--fix", "linked.skill").exit_code == 0
    assert link.is_symlink()
    assert link.read_bytes() == b"\xef\xbb\xbf" + FIXED.replace("\n", "\r\n").encode()
    assert link.stat().st_mode & 0o777 == 0o640


@pytest.mark.parametrize("step", ["fsync", "replace"])
def test_a_full_disk_loses_nothing(library: Path, monkeypatch: pytest.MonkeyPatch, step: str) -> None:
    def full(*_: object) -> NoReturn:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(os, "fsync", full) if step == "fsync" else monkeypatch.setattr(Path, "replace", full)
    result = check("--fix", "--no-cache")
    assert result.exit_code == 1
    assert result.stderr == "error: rest.skill cannot be written: No space left on device; it is unchanged\n"
    assert [(file.name, file.read_text("utf-8")) for file in library.iterdir()] == [("rest.skill", BROKEN)]


def test_a_file_that_is_not_utf_8_is_left_alone(library: Path) -> None:
    content = BROKEN.encode() + b"# caf\xe9\n"
    (library / "rest.skill").write_bytes(content)
    assert check("--fix").exit_code == 1
    assert (library / "rest.skill").read_bytes() == content


def test_a_file_that_was_changed_meanwhile_is_left_alone(library: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from skillc.services.check import fixing

    write: Callable[[fixing.Fixes], int] = fixing.write_fixes

    def late(fixes: fixing.Fixes) -> int:
        (library / "rest.skill").write_text("# new\n", encoding="utf-8")
        return write(fixes)

    monkeypatch.setattr(fixing, "write_fixes", late)
    result = check("--fix")
    assert (result.exit_code, (library / "rest.skill").read_text("utf-8")) == (1, "# new\n")
    assert "was changed by another program" in result.stderr


@pytest.mark.slow
def test_scenes_are_fixed_too(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    scene = Path("own.ttl")
    right = catalogue.scene_path("iiwa_table").read_text("utf-8")
    scene.write_text(right.replace("skiros:Weight 0.12", 'skiros:Weight "0.12"'), encoding="utf-8")
    task = 'use wiping\nimport "wiping/tasks.skill"\nprefix lab: <http://example.org/lab#>\n'
    task += 'task own { scene "own.ttl" goal lab:Table-1.isClean == true }\n'
    Path("own.skill").write_text(task, encoding="utf-8")
    shown = CliRunner().invoke(skillc, ["check", "--diff", "--unsafe-fixes"])
    assert shown.exit_code == 1 and "-    skiros:SizeX 0.10" in shown.stdout
    assert scene.read_text("utf-8") != right
    fixed = CliRunner().invoke(skillc, ["check", "--fix", "--unsafe-fixes"])
    assert fixed.exit_code == 0 and "fixed 1 problem in 1 file" in fixed.stderr
    assert scene.read_text("utf-8") == right
