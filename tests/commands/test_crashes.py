"""No traceback reaches a user: a failure of skillc's own is one message that names a report."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from skillc.cli.main import main
from skillc.services.check import formatting
from skillc.services.library import libraries

SKILL = 'skill Rest { noplan }\nimpl waiting of Rest { run python "skillc.primitives:StandIn" }\n'
COMMANDS = {
    "check": ["check", "--no-cache", "a.skill"],
    "compile": ["compile", "a.skill", "-o", "build"],
    "doc": ["doc", "a.skill", "-o", "build"],
    "graph": ["graph", "a.skill", "Rest"],
    "fmt": ["fmt", "a.skill"],
}


@pytest.fixture
def library(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "a.skill").write_text(SKILL)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    return tmp_path


def raising(error: BaseException) -> Callable[..., object]:
    def fail(*_: object) -> object:
        raise error

    return fail


@pytest.mark.parametrize("name", COMMANDS)
def test_a_failure_is_one_message_with_a_report(
    name: str, library: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    fail = raising(KeyError("nobody\nthought of it"))
    monkeypatch.setattr(libraries, "compile_library", fail)
    monkeypatch.setattr(formatting, "format_source", fail)
    monkeypatch.setattr(sys, "argv", ["skillc", *COMMANDS[name]])
    with pytest.raises(SystemExit) as ended:
        main(COMMANDS[name])
    said = capsys.readouterr()
    assert ended.value.code == 70
    assert said.out == ""
    assert re.match(rf"internal error: `skillc {name} .*a\.skill.*` failed with KeyError", said.err)
    assert "Traceback" not in said.err
    (report,) = library.glob("skillc-crash-*.txt")
    assert str(report) in said.err
    assert "nobody" in report.read_text() and "Traceback" in report.read_text()


def test_an_interrupt_is_no_failure(library: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(libraries, "compile_library", raising(KeyboardInterrupt()))
    with pytest.raises(SystemExit) as ended:
        main(COMMANDS["check"])
    assert ended.value.code == 130
    assert not list(library.glob("skillc-crash-*"))


def test_a_reader_that_goes_is_no_failure(library: Path) -> None:
    (library / "many.skill").write_text("class A\n" * 100)
    code = "from skillc.cli.main import main; main(['check', '--no-cache', 'many.skill'])"
    environment = {**os.environ, "XDG_CACHE_HOME": str(library)}
    with subprocess.Popen(
        [sys.executable, "-c", code],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env=environment,
        preexec_fn=lambda: signal.signal(signal.SIGPIPE, signal.SIG_IGN),
    ) as process:
        assert process.stdout is not None and process.stderr is not None
        process.stdout.close()
        said = process.stderr.read().decode()
    assert process.returncode == 141
    assert "Traceback" not in said and "rror" not in said
