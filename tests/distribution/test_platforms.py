"""What differs between systems is in one package: the source of all others is read, and asks for no system by name.

That nothing is used which Windows or macOS does not have is what `make check` finds, by mypy for these systems.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

from skillc_runtime.platforms import sandbox, sandbox_program

ROOT = Path(__file__).parents[2]
FOLDERS = ("dsl", "ontology", "compiler", "runtime", "app", "skills_src")
PLATFORMS = ROOT / "runtime/skillc_runtime/platforms"
MODULES = {"fcntl", "termios", "tty", "pty", "resource", "select", "msvcrt", "winreg", "_winapi", "pwd", "grp", "posix"}
QUESTIONS = {"sys.platform", "os.name", "os.uname"}
PROCESSES = {f"os.{each}" for each in ("fork", "kill", "killpg", "waitpid", "setsid", "getpgrp", "sysconf", "pread")}
SIGNALS = {f"signal.SIG{each}" for each in ("HUP", "QUIT", "KILL", "ALRM", "TSTP", "CONT", "XFSZ", "USR1", "BREAK")}
FILES = ("/proc", "/sys/fs", "/dev/")


def find_differences(text: str) -> Iterator[str]:
    """Yield what the source of a module takes from one system only, or asks about it."""
    for node in ast.walk(ast.parse(text)):
        match node:
            case ast.Import(names=names):
                yield from (each.name for each in names if each.name in MODULES)
            case ast.ImportFrom(module=str(module)) if module in MODULES:
                yield module
            case ast.Attribute(value=ast.Name(id=base), attr=attribute):
                if f"{base}.{attribute}" in QUESTIONS | PROCESSES | SIGNALS:
                    yield f"{base}.{attribute}"
            case ast.Constant(value=str(value)) if value.startswith(FILES):
                yield value
            case _:
                pass


@pytest.mark.slow
def test_no_other_package_asks_which_system_it_runs_on() -> None:
    sources = [each for folder in FOLDERS for each in (ROOT / folder).rglob("*.py") if PLATFORMS not in each.parents]
    found = {
        str(each.relative_to(ROOT)): differences
        for each in sources
        if (differences := sorted(set(find_differences(each.read_text("utf-8")))))
    }
    assert len(sources) > 500
    assert found == {}


@pytest.mark.parametrize(
    "text, found",
    [
        ("import fcntl", "fcntl"),
        ("def f():\n    from termios import tcgetattr", "termios"),
        ("if sys.platform == 'win32': pass", "sys.platform"),
        ("os.kill(pid, signal.SIGTERM)", "os.kill"),
        ("for n in (signal.SIGINT, signal.SIGHUP): pass", "signal.SIGHUP"),
        ("Path('/proc/meminfo').read_text()", "/proc/meminfo"),
    ],
)
def test_each_kind_of_difference_is_found(text: str, found: str) -> None:
    assert list(find_differences(text)) == [found]
    assert list(find_differences("import os, signal\nsignal.signal(signal.SIGINT, handle)\nos.fsync(3)")) == []


def test_the_sandbox_and_the_side_that_starts_it_have_one_exit_code_for_what_cannot_start() -> None:
    assert sandbox.NOT_STARTED == sandbox_program.NOT_STARTED
