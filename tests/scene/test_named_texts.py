"""A misspelt posture is reported where it is written, before anything runs; so is any text that names nothing."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from skillc.cli.main import skillc
from skillc.lsp.libraries import Libraries
from skillc.services.check import library_checks
from skillc.services.library.files import find_library
from skillc_ontology import catalogue

HEAD = """use rparts
import "motion.skill"
prefix lab: <http://example.org/lab#>

skill Fold {
    in  arm: ArmDevice
    opt how: Text = "%s"
    noplan
}
impl folded of Fold {
    let  rest = "%s"
    do seq {
        TakePosture(arm, posture: how)
        TakePosture(arm, posture: rest)
        TakePosture(arm, posture: "%s")
    }
}
"""
TASK = """
task t {
    scene "%s"
    do    %s
}
"""
REST = """
lab:rest a skillc:Posture ; skillc:postureName "rest" ; skillc:jointValues "0.0 0.35 0.0 -1.75 0.0 1.04 0.0" .
skillc:iiwa14-sheet skillc:hasPosture lab:rest .
"""
REST_OF_UR = REST.replace("iiwa14", "ur5e").replace(" 1.04 0.0", " 1.04")
OWN_SKILL = """use rparts
prefix lab: <http://example.org/lab#>

skill Own {
    in  arm: ArmDevice
    opt posture: Text = "hoem"
    noplan
}
impl own of Own {
    run python "MODULE:Own"
}
"""
CONTROLLER = "http://rvmi.aau.dk/ontologies/skiros.owl#CompliantController"
OWN = """
from types import MappingProxyType
from skillc_runtime.primitives.primitive import Primitive, Status

class Own(Primitive):
    text_names = NAMES
    def __init__(self, cell, *, arm, posture):
        super().__init__(cell)
    def tick(self):
        return Status.SUCCESS
"""


def told(folder: Path, text: str, *options: str) -> list[tuple[str, str, str, str]]:
    """Check a library; return severity, message, help and the text at its place of what is reported."""
    file = folder / "t.skill"
    file.write_text(text, "utf-8")
    output = CliRunner().invoke(skillc, ["check", str(folder), "--json", "--no-cache", *options]).stdout
    lines = text.split("\n")
    found = json.loads(output)
    assert {each["name"] for each in found if each["severity"] == "error"} <= {"unknown-value"}
    return [
        (d["severity"], d["message"], d["help"], lines[d["line"] - 1][d["column"] - 1 : d["end_column"] - 1])
        for d in found
        if d["name"] == "unknown-value"
    ]


@pytest.mark.parametrize(
    ("texts", "help_"),
    [
        (("hoem", "home", "home"), "did you mean `home`?"),
        (("home", "Home", "home"), "did you mean `home`?"),
        (("home", "home", "zzz"), "there is `home`"),
    ],
)
def test_without_a_scene_a_posture_of_no_sheet_is_a_warning(
    tmp_path: Path, texts: tuple[str, str, str], help_: str
) -> None:
    (wrong,) = set(texts) - {"home"}
    message = f'nothing has the skillc:postureName "{wrong}"; there is "home"'
    assert told(tmp_path, HEAD % texts) == [("warning", message, help_, f'"{wrong}"')]


def test_postures_of_sheets_are_not_reported(tmp_path: Path) -> None:
    assert told(tmp_path, HEAD % (("home",) * 3)) == []


SAID = 'lab:Iiwa-1 has no skillc:postureName "hoem"; it has "home"'
HELP = "did you mean `home`?"


@pytest.mark.parametrize(
    ("texts", "call"),
    [
        (("home",) * 3, 'TakePosture(arm: lab:Iiwa-1, posture: "hoem")'),
        (("home",) * 3, 'Fold(arm: lab:Iiwa-1, how: "hoem")'),
        (("hoem", "home", "home"), "Fold(arm: lab:Iiwa-1)"),
        (("home", "hoem", "home"), "Fold(arm: lab:Iiwa-1)"),
        (("home", "home", "hoem"), "seq { Fold(arm: lab:Iiwa-1)  Fold(arm: lab:Iiwa-1) }"),
    ],
)
def test_in_a_scene_a_misspelt_posture_is_an_error_once_where_it_is_written(
    tmp_path: Path, texts: tuple[str, str, str], call: str
) -> None:
    text = (
        HEAD % texts + TASK % ("iiwa_table.ttl", call) + (TASK % ("iiwa_table.ttl", call)).replace("task t", "task u")
    )
    (found, *more) = told(tmp_path, text)
    assert found == ("error", SAID, HELP, '"hoem"')
    assert len(more) == ('"hoem"' not in texts and call.count("hoem"))
    assert set(more) <= {found}


def test_the_postures_of_a_scene_count(tmp_path: Path) -> None:
    (tmp_path / "s.ttl").write_text(catalogue.scene_path("iiwa_table").read_text("utf-8") + REST, "utf-8")
    assert told(tmp_path, HEAD % ("home", "rest", "rest") + TASK % ("s.ttl", "Fold(arm: lab:Iiwa-1)")) == []
    assert told(tmp_path, HEAD % ("home", "rest", "rest"), "--scene", str(tmp_path / "s.ttl")) == []
    assert len(told(tmp_path, HEAD % ("home", "rest", "rest"))) == 2


def test_only_the_postures_of_the_arm_that_moves_count(tmp_path: Path) -> None:
    (tmp_path / "s.ttl").write_text(catalogue.scene_path("two_robots").read_text("utf-8") + REST_OF_UR, "utf-8")
    both = 'seq { TakePosture(arm: lab:Ur5e-1, posture: "rest")  TakePosture(arm: lab:Iiwa-1, posture: "rest") }'
    message = 'lab:Iiwa-1 has no skillc:postureName "rest"; it has "home"'
    assert [each[:2] for each in told(tmp_path, HEAD % (("home",) * 3) + TASK % ("s.ttl", both))] == [
        ("error", message)
    ]


def test_what_may_fail_in_a_task_is_a_warning(tmp_path: Path) -> None:
    text = HEAD % (("home",) * 3) + TASK % ("iiwa_table.ttl", 'try { TakePosture(arm: lab:Iiwa-1, posture: "hoem") }')
    assert [each[0] for each in told(tmp_path, text)] == ["warning"]


def test_a_run_is_refused_before_anything_moves(tmp_path: Path) -> None:
    call = 'TakePosture(arm: lab:Iiwa-1, posture: "hoem")'
    (tmp_path / "t.skill").write_text(HEAD % (("home",) * 3) + TASK % ("iiwa_table.ttl", call), "utf-8")
    result = CliRunner().invoke(skillc, ["run", f"{tmp_path}:t"])
    assert result.exit_code != 0 and SAID in " ".join(result.output.split())


def test_the_warning_can_be_allowed_and_the_error_not(tmp_path: Path) -> None:
    line = '        TakePosture(arm, posture: "zzz")\n'
    allowed = (HEAD % ("home", "home", "zzz")).replace(line, f"        # allow unknown-value: our sheet has it\n{line}")
    assert told(tmp_path, allowed) == []
    assert checked_names(tmp_path) <= {"unused-prefix"}
    (found,) = told(tmp_path, allowed + TASK % ("iiwa_table.ttl", "Fold(arm: lab:Iiwa-1)"))
    assert found[0] == "error"


def checked_names(folder: Path) -> set[str]:
    """Return the names of all that is reported of a library."""
    return {each.name for each in library_checks.check_library(find_library(folder), None)}


@pytest.mark.parametrize("task", ["", TASK % ("iiwa_table.ttl", "Fold(arm: lab:Iiwa-1)")])
def test_the_editor_reports_the_same(tmp_path: Path, task: str) -> None:
    file = tmp_path / "t.skill"
    file.write_text(HEAD % ("hoem", "home", "zzz") + task, "utf-8")
    libraries = Libraries((tmp_path,))
    libraries.write(file.as_uri(), file.read_text("utf-8"))
    shown = libraries.problems_of_scenes(libraries.view(file.as_uri()).root)
    checked = [d for d in library_checks.check_library(find_library(tmp_path), None) if d.name == "unknown-value"]
    assert len(checked) == 2
    assert {(d.span.line, d.span.column, d.severity, d.message) for d in shown} == {
        (d.span.line, d.span.column, d.severity, d.message) for d in checked
    }


@pytest.mark.parametrize(
    ("names", "count"),
    [
        (f'{{"posture": ("arm", "{CONTROLLER}")}}', 1),
        ('{"posture": ("arm", "http://example.org/lab#unknown")}', 0),
        (f'{{"posture": ("arm", "http://example.org/lab#unknown", "{CONTROLLER}")}}', 0),
        ("MappingProxyType({})", 0),
    ],
)
def test_any_primitive_may_say_what_its_texts_name(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, names: str, count: int
) -> None:
    module = tmp_path.name
    (tmp_path / f"{module}.py").write_text(OWN.replace("NAMES", names), "utf-8")
    monkeypatch.syspath_prepend(str(tmp_path))
    text = OWN_SKILL.replace("MODULE", module)
    assert len(told(tmp_path, text + TASK % ("iiwa_table.ttl", "Own(arm: lab:Iiwa-1)"))) == count


def test_names_of_another_form_are_refused_with_the_class(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "own_bad.py").write_text(OWN.replace("NAMES", '{"posture": "label"}'), "utf-8")
    monkeypatch.syspath_prepend(str(tmp_path))
    text = OWN_SKILL.replace("MODULE", "own_bad") + TASK % ("iiwa_table.ttl", "Own(arm: lab:Iiwa-1)")
    (tmp_path / "t.skill").write_text(text, "utf-8")
    (found,) = (d for d in library_checks.check_library(find_library(tmp_path), None) if d.severity == "error")
    assert (
        found.name == "no-implementation-fits" and "`text_names` of `own_bad:Own` is not {parameter:" in found.message
    )
