"""What goes wrong is one family of errors, each a sentence; nothing is printed and no state of the process changes."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

import skillc
from skillc_ontology import catalogue

BROKEN_SCENE = "@prefix skillc: <https://w3id.org/skillc/core#> .\n<urn:a> a skillc:Nothing .\n"


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "broken.skill").write_text("use skillc\nskill Rest { in arm: Amr }\n")
    (tmp_path / "copy (2).skill").write_text("use skillc\n")
    (tmp_path / "scenes").mkdir()
    (tmp_path / "scenes" / "broken.ttl").write_text(BROKEN_SCENE)
    (tmp_path / "scenes" / "no.ttl").write_bytes(b"\xff\xfe\x00")
    return tmp_path


CASES: dict[str, tuple[Callable[[], object], str]] = {
    "no library": (lambda: skillc.load_library("nowhere"), "there is no file or folder nowhere"),
    "number for a path": (lambda: skillc.load_library(3), "the library must be a path, as a text or as a"),  # type: ignore[arg-type]
    "bytes for a path": (lambda: skillc.open_scene(b"x"), "the scene must be a path"),  # type: ignore[arg-type]
    "null in a path": (lambda: skillc.open_run("a\0b"), "the folder of a run must be a path"),
    "empty path": (lambda: skillc.load_library(""), "the library must be a path"),
    "broken library": (lambda: skillc.load_library("broken.skill"), "broken.skill:2:22: there is no class `Amr`"),
    "no scene": (lambda: skillc.open_scene("nowhere.ttl"), "there is no file nowhere.ttl"),
    "broken scene": (lambda: skillc.open_scene("scenes/broken.ttl"), "broken.ttl:2:"),
    "no text": (lambda: skillc.open_scene("scenes/no.ttl"), "no.ttl"),
    "no such task": (lambda: skillc.run("contact:pres_button"), "did you mean `press_button`"),
    "no such task in a file with brackets": (lambda: skillc.run("copy (2).skill:rest"), "no task `rest`"),
    "task and goal": (lambda: skillc.plan("contact:press_button", goal="x"), "cannot be used with"),
    "number for a task": (lambda: skillc.run(42), "the task must be a text, not 42"),  # type: ignore[arg-type]
    "nothing": (lambda: skillc.run(), "name either a TASK"),
    "skill for a task": (
        lambda: skillc.run("contact:PressButton"),
        "is a skill, not a task: `--scene FILE --call 'PressButton(",
    ),
    "call for a task": (lambda: skillc.run("Wipe(lab:Table-1)"), "given as `--scene FILE --call 'Wipe(lab:Table-1)'`"),
    "plan of a call": (lambda: skillc.plan("Wipe(lab:Table-1)"), "a call of a skill has no plan: name a task, or give"),
    "goal for a task": (lambda: skillc.run("lab:A.isClean == true"), "given as `--scene FILE --goal 'lab:A.isClean"),
    "goal without a scene": (lambda: skillc.run(goal="lab:A.isClean == true"), "--goal needs the scene"),
    "call for a goal": (
        lambda: skillc.plan(goal="Wipe(lab:Table-1)", scene="iiwa_table"),
        "write what it makes true: `lab:Table-1.isClean == true`",
    ),
    "wrong seed": (lambda: skillc.run("contact:press_button", seed=1.5), "`seed` must be a whole number"),  # type: ignore[arg-type]
    "wrong backend": (lambda: skillc.run("contact:press_button", backend="real"), "kinematic, mujoco"),
    "wrong pace": (lambda: skillc.start("contact:press_button", pace="slow"), "`slow` is no pace"),
    "wrong folder": (lambda: skillc.run("contact:press_button", out="broken.skill"), "cannot write to"),
    "no recording": (lambda: skillc.open_run("."), "has no events.jsonl"),
    "no trials": (lambda: skillc.trials("contact:press_button", 0), "a whole number of at least 1"),
    "two places of trials": (
        lambda: skillc.trials("contact:press_button", 2, jobs=2, executor=ThreadPoolExecutor(1)),
        "either `jobs` or `executor` says where the trials run",
    ),
    "no executor": (
        lambda: skillc.trials("contact:press_button", 2, executor=2),  # type: ignore[arg-type]
        "`executor` must be a concurrent.futures.Executor, not 2",
    ),
    "no plan": (lambda: skillc.plan(goal="lab:Dock contain lab:Whiteboard-1", scene="ur5e_whiteboard"), "no plan"),
    "arguments": (lambda: skillc.plan("contact:press_button", arguments={"a": "1"}), "takes no arguments"),
    "arguments of a goal": (
        lambda: skillc.plan(goal="x", scene="ur5e_whiteboard", arguments={"a": "1"}),
        "the values of the parameters of a TASK",
    ),
    "arguments in a list": (lambda: skillc.run("x", arguments=["a"]), "a mapping of names to values"),  # type: ignore[arg-type]
    "no value": (lambda: skillc.run("x", arguments={"a": None}), "`a` must be a text, not None"),
    "signals without a folder": (lambda: skillc.run("contact:press_button", signals="csv"), "require `out`"),
    "gif without a folder": (lambda: skillc.run("contact:press_button", gif=True), "require `out`"),
    "format of signals": (
        lambda: skillc.run("contact:press_button", signals="xml", out="o"),  # type: ignore[arg-type]
        '`signals` must be "csv" or "parquet"',
    ),
    "places in one text": (
        lambda: skillc.start("contact:press_button", breakpoints="Press"),
        "`breakpoints` must be a sequence of texts",
    ),
    "no flag": (lambda: skillc.run("contact:press_button", film="no"), "`film` must be True or False"),  # type: ignore[arg-type]
    "minimise": (lambda: skillc.plan("contact:press_button", minimise="time"), '"work" or "makespan"'),  # type: ignore[arg-type]
}


@pytest.mark.parametrize("case", CASES)
def test_each_mistake_is_a_sentence(case: str, capfd: pytest.CaptureFixture[str]) -> None:
    act, sentence = CASES[case]
    before = (dict(os.environ), Path.cwd(), signal.getsignal(signal.SIGINT), signal.getsignal(signal.SIGQUIT))
    with pytest.raises(skillc.SkillcError) as raised:
        act()
    assert sentence in str(raised.value)
    assert "Traceback" not in str(raised.value)
    assert capfd.readouterr() == ("", "")
    after = (dict(os.environ), Path.cwd(), signal.getsignal(signal.SIGINT), signal.getsignal(signal.SIGQUIT))
    assert after == before


def test_diagnostics_have_places_and_texts() -> None:
    with pytest.raises(skillc.DiagnosticsError) as raised:
        skillc.load_library("broken.skill")
    found = next(each for each in raised.value.diagnostics if each.name == "unknown-class")
    assert (found.severity, found.span.path, found.span.line) == ("error", "broken.skill", 2)
    assert "Amr" in raised.value.texts["broken.skill"].text


def test_no_plan_says_whether_that_is_proved() -> None:
    with pytest.raises(skillc.PlanningError) as raised:
        skillc.plan(goal="lab:Dock contain lab:Whiteboard-1", scene="ur5e_whiteboard")
    assert raised.value.proved
    assert raised.value.explanation


def test_an_edit_is_made_whole_or_not_at_all() -> None:
    scene = skillc.open_scene("ur5e_whiteboard")
    before = scene.state
    with pytest.raises(skillc.RequestError, match="irreflexive"), scene.edit("Ada", "to try") as now:
        now.set("lab:Eraser-1", "skiros:Weight", 0.2)
        now.relate("lab:Dock", "skiros:contain", "lab:Dock")
    with pytest.raises(skillc.RequestError, match="no relation"), scene.edit("Ada", "to try") as now:
        now.relate("lab:Dock", "skiros:contains", "lab:Eraser-1")
    with pytest.raises(skillc.RequestError, match="`why` must be a text"), scene.edit("Ada", ""):
        pass
    assert scene.state is before
    with pytest.raises(skillc.RequestError, match="nothing to undo"):
        scene.undo()


def test_ontology_folders_of_a_project_do_not_outlive_a_call(here: Path) -> None:
    folder = here / "p" / "ontology"
    folder.mkdir(parents=True)
    (here / "p" / "skillc.toml").write_text('name = "p"\nontology = ["ontology"]\n')
    (folder / "more.ttl").write_text("this is no Turtle")
    (here / "p" / "a.skill").write_text("use skillc\n")
    assert any("more.ttl" in each.span.path for each in skillc.check("p"))
    assert catalogue.user_folders() == ()
    skillc.plan("contact:press_button")
