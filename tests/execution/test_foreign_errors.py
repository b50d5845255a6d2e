"""Whatever code of skills raises, wherever it is called, the run ends safely and says why; only Ctrl-C goes through."""

from __future__ import annotations

from pathlib import Path

import pytest

from execution.loops import StagedCell, Watched, staged
from execution.ways import check_nothing_left
from skillc_model import tree
from skillc_runtime.devices.cell import Cell
from skillc_runtime.primitives.primitive import Primitive, Status
from skillc_runtime.recording import commands
from skillc_runtime.recording.events import NodeEnded, Note, TaskEnded
from skillc_runtime.world.state.python_calls import EvaluationError, call_python, load_python
from tree.library import Library, act, seq, with_


class PanicError(BaseException):
    """What extension modules raise, for example, when they panic."""


ERRORS: dict[str, type[BaseException]] = {
    "RuntimeError": RuntimeError,
    "SystemExit": SystemExit,
    "GeneratorExit": GeneratorExit,
    "PanicError": PanicError,
    "KeyboardInterrupt": KeyboardInterrupt,
}
CAUGHT = [name for name in ERRORS if name != "KeyboardInterrupt"]


class Raising(Primitive):
    """Called `ERROR PHASE`, raises an error in a phase; else it runs until it is halted, or succeeds as `a`."""

    def __init__(self, cell: Cell, *, name: str) -> None:
        super().__init__(cell)
        self._error, _, self._phase = name.partition(" ")
        self._raise_in("make")

    def start(self) -> None:
        self._raise_in("start")

    def tick(self) -> Status:
        self._raise_in("tick")
        return Status.SUCCESS if self._phase in ("", "release") else Status.RUNNING

    def halt(self, reason: str) -> None:
        self._raise_in("halt")

    def pause(self) -> None:
        self._raise_in("pause")

    def withdraw(self) -> None:
        self._raise_in("withdraw")

    def approach(self) -> bool:
        self._raise_in("approach")
        return True

    def resume(self) -> None:
        self._raise_in("resume")

    def release(self) -> None:
        self._raise_in("release")

    def _raise_in(self, phase: str) -> None:
        if self._phase == phase:
            raise ERRORS[self._error](f"in {phase}")


def submit(body: tree.Node) -> tuple[StagedCell, Watched]:
    return staged(body, library=Library(f"{__name__}:{Raising.__name__}"))


def reasons(watched: Watched) -> str:
    """Return all reasons that a run told."""
    failures = [event.failure for event in (*watched.told(NodeEnded), *watched.told(TaskEnded)) if event.failure]
    return "\n".join([*(failure.message for failure in failures), *(note.message for note in watched.told(Note))])


def pause_and_resume(watched: Watched) -> None:
    """Pause for longer than a tool presses, and go on."""
    watched.until_end_or("running")
    watched.request(commands.PauseRun())
    for _ in range(500):
        watched.loop.tick()
    if not watched.run.ended:
        watched.request(commands.Resume())


@pytest.mark.parametrize("error", CAUGHT)
@pytest.mark.parametrize("phase", ["make", "start", "tick", "halt", "pause", "withdraw", "approach", "resume"])
def test_a_primitive_that_raises_ends_its_run_with_the_reason(phase: str, error: str) -> None:
    cell, watched = submit(seq(act(f"{error} {phase}"), act("a")))
    if phase in ("pause", "withdraw", "approach", "resume"):
        pause_and_resume(watched)
    elif phase == "halt":
        watched.until("running")
        watched.request(commands.Stop("enough"))
    assert watched.until_end() == ("stopped" if phase == "halt" else "failed")
    assert f"{error}: in {phase} (test_foreign_errors.py:" in reasons(watched)
    assert cell.secured
    assert len(watched.told(TaskEnded)) == 1
    check_nothing_left(cell, watched)


@pytest.mark.parametrize("error", CAUGHT)
def test_a_scoped_primitive_that_raises_when_it_is_released_does_not_keep_others_from_it(error: str) -> None:
    cell, watched = submit(with_("a", with_(f"{error} release", act("a"))))
    assert watched.until_end() in ("succeeded", "failed")
    assert f"{error}: in release" in reasons(watched)
    check_nothing_left(cell, watched)


def test_ctrl_c_in_a_primitive_is_not_its_failure() -> None:
    _, watched = submit(act("KeyboardInterrupt tick"))
    with pytest.raises(KeyboardInterrupt):
        watched.until_end()


@pytest.mark.parametrize("error", ERRORS)
def test_a_function_that_raises_fails_the_condition(error: str) -> None:
    def fail(_state: object) -> None:
        raise ERRORS[error]("in vain")

    expected = KeyboardInterrupt if error == "KeyboardInterrupt" else EvaluationError
    with pytest.raises(expected) as raised:
        call_python(fail, "area", None)
    assert str(raised.value) == ("in vain" if expected is KeyboardInterrupt else f"area() failed: {error}: in vain")


def test_a_module_that_ends_the_program_when_it_is_imported_cannot_be_loaded(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "panicking.py").write_text("class Panic(BaseException): ...\nraise Panic('at once')\n")
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(EvaluationError, match=r"^the Python function panicking:f cannot be loaded: Panic: at once$"):
        load_python("panicking:f")
