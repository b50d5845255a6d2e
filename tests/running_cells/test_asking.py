"""A skill asks an operator, who answers, or nobody does."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

import pytest

from running_cells.asking import write_asking_yard
from running_cells.test_operations import run_all
from skillc.cells.host import CellHost
from skillc.cells.journal.reading import JournalReader
from skillc.cells.opening import open_cell
from skillc.cells.snapshot import decode_snapshot
from skillc.contract.operation import OperationRequest, OperationStatus
from skillc.contract.rehearsal import RehearsalRequest
from skillc.server.jobs.kinds.rehearsal import rehearse
from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import find_library
from skillc.services.project.backends import make_backend
from skillc.services.reporting.reporter import SilentReporter
from skillc_runtime.execution.consistency import check_events
from skillc_runtime.execution.repeat import repeat_run
from skillc_runtime.recording.commands import AnswerPrompt
from skillc_runtime.recording.events import Event, PromptsChanged, Requested
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.model import WorldModel

ASKING = OperationRequest(task="confirm")


@contextmanager
def asking(folder: Path, default: str = "", takes_ms: int = 10) -> Iterator[CellHost]:
    """Open a cell in which a skill of the operation `asking` asks."""
    with open_cell(write_asking_yard(folder, default, takes_ms), SilentReporter()) as host:
        host.submit("asking", ASKING)
        while not host.loop.runs[0].prompts:
            if not host.tick():
                host.loop.wait(0.01)
        yield host


def status(host: CellHost) -> OperationStatus:
    return host._operations["asking"].describe("yard", 0)


def events(host: CellHost) -> list[Event]:
    with closing(JournalReader(host.settings.journal)) as reader:
        return [each.event for each in reader.envelopes("asking")]


@pytest.mark.parametrize(("choice", "end"), [("yes", "succeeded"), ("no", "failed")])
def test_an_operator_is_asked_and_the_answer_decides(tmp_path: Path, choice: str, end: str) -> None:
    with asking(tmp_path) as host:
        (prompt,) = status(host).prompts
        assert (prompt.text, prompt.choices, prompt.default) == ("Is the cart free?", ("yes", "no"), "")
        assert "answer" in status(host).allowed and host.loop.runs[0].stands
        for wrong, said in (
            (AnswerPrompt("perhaps"), "`perhaps` is no choice; there is `yes`, `no`"),
            (AnswerPrompt(choice, prompt=99), f"there is no prompt 99: {prompt.id}: Is the cart free?"),
        ):
            refused = host.request("asking", wrong)
            host.tick()
            assert said in str(refused.refused)
        host.request("asking", AnswerPrompt(choice, prompt.id, who="Ada"))
        (ended,) = run_all(host)
        assert (ended.state, ended.prompts) == (end, ())
        found = events(host)
        assert [len(each.prompts) for each in found if isinstance(each, PromptsChanged)] == [1, 0]
        assert [bool(each.refused) for each in found if isinstance(each, Requested)] == [True, True, False]
        library = compile_valid(find_library(Path(host.settings.library)))
        scene = load_scene(Path(host.settings.scene), library.vocabulary)
        assert check_events(found, library, scene) is None
        repeated = repeat_run(found, library, make_backend("kinematic", WorldModel(scene), 0))
        assert repeated.difference is None and repeated.ended


def test_nobody_is_waited_for_for_ever(tmp_path: Path) -> None:
    with asking(tmp_path / "without") as host:
        (ended,) = run_all(host)
        assert ended.state == "failed" and ended.failure is not None
        assert ended.failure.message == 'nobody has answered "Is the cart free?" within 60 s'
        assert "answer" not in ended.allowed
    with asking(tmp_path / "with", default="yes") as host:
        (ended,) = run_all(host)
        assert ended.state == "succeeded"


def test_who_is_asked_need_not_answer_what_is_stopped(tmp_path: Path) -> None:
    with asking(tmp_path) as host:
        host.stop("asking", "enough")
        (ended,) = run_all(host)
        assert (ended.state, ended.prompts) == ("stopped", ())
        assert [len(each.prompts) for each in events(host) if isinstance(each, PromptsChanged)] == [1, 0]


@pytest.mark.parametrize(
    ("written", "said"),
    [
        ('choices: "yes"', '`choices` has 2 to 9 different texts, such as "yes | no"; it is "yes"'),
        ('choices: "yes | yes"', "2 to 9 different texts"),
        ('choices: "yes | no", default: "maybe"', 'the default "maybe" is none of the choices "yes | no"'),
    ],
)
def test_choices_that_cannot_be_are_refused_before_anything_happens(tmp_path: Path, written: str, said: str) -> None:
    with open_cell(write_asking_yard(tmp_path), SilentReporter()) as host:
        host.submit("asking", OperationRequest(call=f'Ask(text: "Is the cart free?", {written})'))
        (ended,) = run_all(host)
        assert ended.state == "failed" and ended.failure is not None and said in ended.failure.message
        assert not any(isinstance(each, PromptsChanged) for each in events(host))


def test_who_is_asked_keeps_nobody_from_working(tmp_path: Path) -> None:
    """An operation that holds the whole cell begins, goes on and ends while another one waits for an answer."""
    with asking(tmp_path, takes_ms=300) as host:
        assert status(host).devices == ()
        host.submit("working", OperationRequest(task="carry_two"))
        host.submit("asked later", ASKING)
        while not all(each.prompts for each in host.loop.runs if each.id != "working"):
            assert host.tick() or not host.loop.wait(0.01)
        states = {each.id: each.state for each in host.loop.runs}
        assert states == {"asking": "running", "working": "running", "asked later": "running"}
        assert host._operations["working"].describe("yard", 0).devices is None
        host.stop("asked later", "not needed")
        host.request("asking", AnswerPrompt("yes"))
        ended = {each.id: each.state for each in run_all(host)}
    assert ended == {"asking": "succeeded", "working": "succeeded", "asked later": "stopped"}
    assert list(ended) == ["asked later", "asking", "working"]


@pytest.mark.parametrize(
    ("default", "answers", "end"),
    [
        ("yes", (), "succeeded"),
        ("", ("perhaps", "yes"), "succeeded"),
        ("yes", ("no",), "failed"),
        ("", (), 'it asks "Is the cart free?", and a rehearsal has no answer: give one of its choices, "yes", "no"'),
    ],
)
def test_a_rehearsal_waits_for_nobody(tmp_path: Path, default: str, answers: tuple[str, ...], end: str) -> None:
    with open_cell(write_asking_yard(tmp_path, default), SilentReporter()) as host:
        known = decode_snapshot(host.take_twin())
    done = rehearse(RehearsalRequest(task="confirm", answers=answers), tmp_path / "rehearsal", known)
    assert end in (done.status, done.failure) and done.sim_time_s < 1.0
