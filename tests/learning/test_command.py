"""`skillc learn` as a user meets it."""

from __future__ import annotations

import json
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from skillc import extras
from skillc.cli.main import skillc
from skillc.services.library.files import SHIPPED
from waiting import LONG_S


def run(*arguments: str | Path) -> Result:
    result = CliRunner().invoke(skillc, ["learn", *map(str, arguments)])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


@pytest.mark.parametrize(
    ("arguments", "why"),
    [
        (("clean_table", "--minimise", "tim"), "there is no figure `tim`; did you mean `time`?"),
        (("clean_table", "--minimise", "time", "--subject-to", "coverage"), "`coverage` is no constraint"),
        (("clean_tabel", "--minimise", "time"), "did you mean `clean_table`?"),
        (("clean_table", "--minimise", "time", "--scheduler", "tcp://cluster:8786"), "use TLS, tls://cluster:8786"),
    ],
)
def test_a_mistake_is_named_before_anything_runs(arguments: tuple[str, ...], why: str, tmp_path: Path) -> None:
    result = run(*arguments, "--out", tmp_path / "out")
    assert result.exit_code == 2
    assert why in " ".join(result.stderr.split())
    assert not (tmp_path / "out").exists()


def test_what_is_not_installed_is_named(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(extras, "find_spec", lambda name: None if name == "optuna" else object())
    result = run("clean_table", "--minimise", "time", "--out", tmp_path / "out")
    assert result.exit_code == 2
    assert "pip install 'skillc[learn]'" in " ".join(result.stderr.split())


@pytest.mark.sim
def test_what_is_interrupted_goes_on(tmp_path: Path) -> None:
    words = ("learn", "contact:press_button", "--minimise", "time", "--parameters", "PressButton.pace", "--out", "out")
    few = ("--candidates", "3", "--trials", "1", "--fresh", "0", "--jobs", "1")
    command = (sys.executable, "-m", "skillc", *words, *few)
    with subprocess.Popen(command, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert process.stderr is not None
        for line in process.stderr:
            if line.startswith("1 of 3 candidates"):
                process.send_signal(signal.SIGINT)
                break
        out, err = process.communicate(timeout=LONG_S)
    assert (process.returncode, "the same command goes on from here" in " ".join(err.split())) == (3, True)
    assert "1 of 3 candidates tried" in out
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.stderr.startswith("1 of 3 candidates, 1 trials")
    assert "3 of 3 candidates tried in 3 trials" in done.stdout


@pytest.mark.sim
def test_a_button_is_pressed_faster(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    shutil.copytree(SHIPPED / "contact", tmp_path / "press")
    monkeypatch.chdir(tmp_path)
    arguments = ("press:press_button", "--minimise", "simulated_time", "--subject-to", "greatest_force <= 120 %")
    few = ("--candidates", 4, "--trials", 1, "--fresh", 1, "--parameters", "PressButton.pace", "--jobs", 1)
    result = run(*arguments, *few, "--json")
    learned = json.loads(result.stdout)
    assert [each["parameter"] for each in learned["parameters"]] == ["pace"]
    assert learned["candidates"][0]["values"] == ["0.4"]
    assert len(learned["candidates"]) == 4
    assert result.exit_code == (3 if learned["chosen"] is None else 0)
    assert Path(learned["recordings"]["defaults"], "recording.mcap").is_file()
    assert learned["chosen"] is not None
    page = (tmp_path / "learning" / "press_button" / "learned.html").read_text()
    assert 'href="runs/candidate-' in page
    assert page.count("<circle") == 4
    again = run(*arguments, *few, "--apply")  # nothing is left to run
    assert again.exit_code == 0, again.output
    text = (tmp_path / "press" / "press.skill").read_text()
    value = learned["candidates"][learned["chosen"]]["values"][0]
    assert f"refine pace: Number = {value}" in " ".join(text.split())
    assert "# Learned for press_button in ur5e_button.ttl: least simulated_time," in text
    fresh = learned["fresh"]["objectives"][0]
    assert fresh["learned"] < fresh["defaults"]
