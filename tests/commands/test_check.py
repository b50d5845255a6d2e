"""`skillc check` as a user meets it: forms, paths, the standard input, colours, exit codes."""

import json
import os
import re
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from skillc.cli.main import skillc

SKILL = """use skiros
import "terms.skill"
skill Fetch {
    in   board: Board
    in   count: Nubmer
    pre  board has FrameId
    noplan
}
"""
TERMS = "use skiros\nclass Board < Product\n"


@pytest.fixture
def library(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "lab"
    folder.mkdir()
    (folder / "fetch.skill").write_text(SKILL, encoding="utf-8")
    (folder / "terms.skill").write_text(TERMS, encoding="utf-8")
    monkeypatch.chdir(folder)
    for name in ("NO_COLOR", "FORCE_COLOR", "COLUMNS"):
        monkeypatch.delenv(name, raising=False)
    return folder


def check(*arguments: str | Path, text: str | None = None) -> Result:
    result = CliRunner().invoke(skillc, ["check", *map(str, arguments)], input=text)
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


def names(result: Result) -> list[str]:
    return [each["name"] for each in json.loads(result.stdout)]


def test_without_a_path_the_current_folder_is_checked(library: Path) -> None:
    result = check("--format", "concise")
    assert result.exit_code == 1
    assert result.stdout.splitlines() == [
        "fetch.skill:3:7: warning[no-implementation]: the skill `Fetch` has no implementation, so it cannot run",
        "fetch.skill:5:17: error[unknown-type]: there is no type `Nubmer`",
    ]
    assert result.stderr == "1 error, 1 warning in 1 file; 1 guessed with --fix --unsafe-fixes\n"


def test_sarif_describes_the_rules_with_their_pages(library: Path) -> None:
    run = json.loads(check("--format", "sarif").stdout)["runs"][0]
    assert [rule["id"] for rule in run["tool"]["driver"]["rules"]] == ["no-implementation", "unknown-type"]
    assert all(rule["help"]["text"] for rule in run["tool"]["driver"]["rules"])
    assert [result["level"] for result in run["results"]] == ["warning", "error"]


def test_github_names_files_as_from_here(library: Path) -> None:
    assert "::error file=fetch.skill,line=5,endLine=5,col=17" in check("--format", "github").stdout


def test_each_of_several_paths_is_checked_and_told_once(library: Path) -> None:
    assert names(check("fetch.skill", "terms.skill", ".", "--json")) == ["no-implementation", "unknown-type"]


def test_the_standard_input_belongs_where_it_is_said(library: Path) -> None:
    result = check(
        "-", "--stdin-filename", "fetch.skill", "--format", "concise", text=SKILL.replace("Nubmer", "Number")
    )
    assert (result.exit_code, result.stderr) == (0, "1 warning in 1 file\n")
    assert result.stdout.startswith("fetch.skill:3:7: warning[no-implementation]")


def test_the_standard_input_alone_knows_the_current_folder(library: Path) -> None:
    result = check("-", "--format", "concise", text='import "terms.skill"\nclass Slate < Baord\n')
    assert "stdin.skill:2:15: error[unknown-class]" in result.stdout


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--stdin-filename", "a.skill"], "`-` is not among the paths"),
        (["-", "--stdin-filename", "a.txt"], "a.txt is not a .skill file"),
        (["--unsafe-fixes"], "requires --fix or --diff"),
        (["--watch", "--fix"], "--watch cannot be used"),
        (["-", "fetch.skill", "--fix"], "must be the only path"),
        (["--fix", "wiping"], "the shipped library wiping cannot be changed"),
        (["nowhere"], "there is no file or folder nowhere"),
        (["empty"], "there is no .skill file in empty"),
        (["notes.txt"], "notes.txt is not a .skill file"),
        (["circle.skill"], "circle.skill is a broken link"),
        (["links"], "cannot be read"),
        (["--scene", "nowhere.ttl"], "there is no file nowhere.ttl"),
        (["--format", "xml"], "is not one of"),
    ],
)
def test_a_wrong_command_line_is_answered_with_2(library: Path, arguments: list[str], words: str) -> None:
    (library / "empty").mkdir()
    (library / "notes.txt").touch()
    (library / "circle.skill").symlink_to("circle.skill")
    (library / "links").mkdir()
    (library / "links" / "gone.skill").symlink_to("nowhere.skill")
    result = check(*arguments, text="")
    assert result.exit_code == 2
    assert words in " ".join(result.stderr.split())
    assert result.stdout == ""


def test_folders_that_look_like_files_hidden_ones_and_circles_do_no_harm(library: Path) -> None:
    (library / "folder.skill").mkdir()
    (library / "folder.skill" / "inner.skill").write_text("class A < Nothing\n", encoding="utf-8")
    (library / ".hidden").mkdir()
    (library / ".hidden" / "a.skill").write_text("broken", encoding="utf-8")
    (library / "circle").symlink_to(library, target_is_directory=True)
    found = json.loads(check("--json").stdout)
    assert {each["path"] for each in found} == {"fetch.skill", "folder.skill/inner.skill"}
    assert names(check("folder.skill", "--json")) == ["unknown-class"]


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root can read everything")
def test_a_file_that_cannot_be_read_is_named(library: Path) -> None:
    (library / "terms.skill").chmod(0)
    result = check()
    assert result.exit_code == 2
    assert "terms.skill cannot be read: Permission denied" in result.stderr


def test_colours_are_forced_and_forbidden(library: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    plain = check().stdout
    assert "\x1b" not in plain
    monkeypatch.setenv("FORCE_COLOR", "1")
    coloured = check().stdout
    assert "\x1b[1;31merror[unknown-type]\x1b[0m" in coloured
    assert re.sub(r"\x1b\[[\d;]*m", "", coloured) == plain
    monkeypatch.setenv("NO_COLOR", "1")
    assert check().stdout == plain


def test_the_page_is_as_wide_as_columns_says(library: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "50")
    assert max(len(line) for line in check().stdout.splitlines()) <= 50


def test_an_allowed_warning_is_not_told(library: Path) -> None:
    text = SKILL.replace("Nubmer", "Number").replace(
        "skill F", "# allow no-implementation: every lab has its own\nskill F"
    )
    (library / "fetch.skill").write_text(text, encoding="utf-8")
    result = check()
    assert (result.exit_code, result.stdout, result.stderr) == (0, "", "no problems\n")


def test_explain_lists_by_family_and_shows_pages() -> None:
    listed = CliRunner().invoke(skillc, ["explain"]).stdout
    assert listed.index("\nnames\n") < listed.index("  unknown-class ")
    page = CliRunner().invoke(skillc, ["explain", "unknown-class"]).stdout
    assert page.startswith("unknown-class: A class does not exist\nfamily: names\n")
    assert page.index("\nBad\n\n    ") < page.index("\nGood\n\n    ")
    data = json.loads(CliRunner().invoke(skillc, ["explain", "unknown-class", "--json"]).stdout)
    assert set(data) == {"name", "family", "found_by", "title", "prose", "language", "bad", "good"}


def test_explain_of_a_misspelt_name_offers_the_right_one() -> None:
    result = CliRunner().invoke(skillc, ["explain", "unknwon-class"])
    assert result.exit_code == 2
    assert "did you mean `unknown-class`" in result.stderr
