"""What commands print: text of the user's as it was written, and reports of whatever a task needs or does not."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from rich.spinner import Spinner
from rich.text import Text

from skillc.cli.main import skillc
from skillc.cli.progress.run_output import print_results
from skillc.cli.progress.run_progress import RunProgress
from skillc.cli.progress.trials import TrialProgress
from skillc_runtime.evaluation.report.result import StepResult, TaskResult
from skillc_runtime.world.state.labels.labelled import LabelledIri

LIBRARY = """use skiros

skill Carry {
    in    crate: Product
    in    to:    Location
    infer from:  Location
    pre   from contain crate
    pre   not to contain crate
    post moved: to contain crate
}

impl at_once of Carry { do seq { apply moved } }
"""
SCENE = """@prefix lab: <http://example.org/lab#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
lab:a a skiros:Location ; rdfs:label "[/b]" ; skiros:contain lab:crate .
lab:b a skiros:Location .
lab:crate a skiros:Product .
"""
ODD = ("[bold]bold[/bold]", "[/red] :smile: [", "lab:b contain lab:crate # [/bold] {x}", "[link=x]", "\\[a]")


@pytest.fixture
def lab(tmp_path: Path) -> Path:
    (tmp_path / "depot.skill").write_text(LIBRARY, encoding="utf-8")
    (tmp_path / "scene.ttl").write_text(SCENE, encoding="utf-8")
    return tmp_path


def skillc_in(lab: Path, command: str, goal: str, *more: str) -> Result:
    asked = (command, "--library", str(lab), "--scene", str(lab / "scene.ttl"), "--goal", goal, *more)
    result = CliRunner().invoke(skillc, asked)
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


def test_a_task_without_an_arm_is_run_and_reported(lab: Path) -> None:
    out = lab / "out [bold]"
    result = skillc_in(lab, "run", "lab:b contain lab:crate  # [/bold] :smile:", "--out", str(out))
    assert result.exit_code == 0, result.stderr
    assert "lab:b contain lab:crate  # [/bold] :smile:  finished, not verified" in result.stdout
    assert f"report: {out / 'report.html'}" in result.stdout
    assert {"report.html", "result.json", "events.jsonl"} <= {each.name for each in out.iterdir()}
    assert "no film: there is no arm in the scene" in result.stderr


def test_a_goal_in_brackets_is_printed_when_it_is_planned(lab: Path) -> None:
    result = skillc_in(lab, "plan", "lab:b contain lab:crate  # [/bold]")
    assert result.exit_code == 0 and "Carry(" in result.stdout


def test_a_label_in_brackets_is_listed(lab: Path) -> None:
    result = CliRunner().invoke(skillc, ["world", str(lab / "scene.ttl")])
    assert result.exit_code == 0 and "[/b]" in result.stdout


@pytest.mark.parametrize("text", ODD)
def test_a_table_of_results_has_the_text_as_it_is(text: str, capsys: pytest.CaptureFixture[str]) -> None:
    step = StepResult(skill=text, implementation=text, arguments={"what": text}, source="a.skill:1", status="success")
    result = TaskResult(
        task=text,
        status="failed",
        plan=(step,),
        controllers=(text,),
        robots=(LabelledIri(text, text),),
        variation=text,
        sim_time_s=1.0,
        replanned=(text,),
        failure=text,
    )
    print_results([result], Path(text))
    assert capsys.readouterr().out.count(text) >= 7


@pytest.mark.parametrize("text", ODD)
@pytest.mark.parametrize("terminal", [False, True])
def test_progress_has_the_text_as_it_is(
    text: str, terminal: bool, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    shown: list[str] = []
    update = Spinner.update

    def show(self: Spinner, *, text: Text) -> None:
        shown.append(str(text))
        update(self, text=text)

    monkeypatch.setattr(Spinner, "update", show)
    monkeypatch.setattr(sys.stderr, "isatty", lambda: terminal)
    with RunProgress(text, quiet=False) as live:
        live.say(text)
    told = shown if terminal else [capsys.readouterr().err.strip()]
    assert told == [f"{text}: {text}"]


@pytest.mark.parametrize("text", ODD)
def test_the_bar_of_trials_has_the_text_as_it_is(
    text: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    monkeypatch.setenv("TTY_COMPATIBLE", "1")
    with TrialProgress(text, "none", 1, 0, quiet=False):
        pass
    assert text in capsys.readouterr().err


def test_what_has_no_effect_in_a_scene_is_told_and_the_rest_used(lab: Path) -> None:
    with (lab / "scene.ttl").open("a", encoding="utf-8") as scene:
        scene.write("@prefix rdf: <http://www.w3.org/1999/02/22-rdf-syntax-ns#> .\nlab:a rdf:value 3 .\n")
    result = skillc_in(lab, "plan", "lab:b contain lab:crate")
    assert result.exit_code == 0 and "warning[no-effect]: `rdf:value` has no effect in a scene" in result.stderr
    shown = CliRunner().invoke(skillc, ["world", str(lab / "scene.ttl")])
    assert shown.exit_code == 0 and "warning[no-effect]" in shown.stderr


DEEP = "@prefix : <x:> .\n:a :b " + "[ :b " * 3000 + "( " * 3000
BAD: dict[str, str | bytes] = {
    "empty": "",
    "binary": b"\x00\xff\xfe" * 100,
    "noise": "( ] ; . , [ ) <" * 300,
    "deep": DEEP,
    "closed": ":a :b :c " + ")" * 20000 + " .",
    "foreign": "@prefix f: <http://xmlns.com/foaf/0.1/> . f:me a f:Person .",
}


@pytest.mark.parametrize("name", [*BAD, "fifo", "folder", "missing", "x" * 300])
def test_a_file_that_is_no_scene_is_refused_in_words(lab: Path, name: str) -> None:
    path = lab / f"{name}.ttl"
    match BAD.get(name):
        case None if name == "fifo":
            os.mkfifo(path)
        case None if name == "folder":
            path.mkdir()
        case str() as text:
            path.write_text(text, encoding="utf-8")
        case bytes() as data:
            path.write_bytes(data)
    result = CliRunner().invoke(skillc, ["world", "--library", str(lab), str(path)])
    assert isinstance(result.exception, SystemExit), result.exception
    assert result.exit_code in (1, 2) and "error" in result.stderr.lower()


@pytest.mark.parametrize("place", ["x" * 300, "http://ann:secret@[::1", "ftp://ann:secret@host", "/dev/null"])
def test_a_place_that_is_no_store_is_refused_in_words(lab: Path, place: str) -> None:
    result = CliRunner().invoke(skillc, ["world", str(lab / "scene.ttl"), "--library", str(lab), "--store", place])
    assert isinstance(result.exception, SystemExit), result.exception
    assert result.exit_code == 1 and "error: " in result.stderr and "secret" not in result.output


@pytest.mark.parametrize("goal", ["", "\0", "(" * 10_000, "not " * 2000 + "a", "(not " * 3000 + "(a b)" + ")" * 3000])
def test_a_text_that_is_no_goal_is_refused_in_words(lab: Path, goal: str) -> None:
    result = skillc_in(lab, "plan", goal)
    assert result.exit_code in (1, 2) and "error" in result.stderr.lower()
