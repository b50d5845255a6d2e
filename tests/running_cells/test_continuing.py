"""An operation that was interrupted is continued once, by a decision, and nothing that was done is done again."""

from __future__ import annotations

import shutil
from collections import Counter
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from random import Random

import pytest
from msgspec import structs

from running_cells.test_operations import run_all
from running_cells.yard import CRATES, find_settings, write_yard
from skillc.cells.host import CellHost
from skillc.cells.journal.reading import JournalReader
from skillc.cells.opening import open_cell
from skillc.contract.operation import OperationRequest, OperationStatus
from skillc.errors import RequestError
from skillc.services.reporting.reporter import SilentReporter
from skillc_runtime.recording.events import ImplementationChosen
from skillc_runtime.world.state.terms import CONTAIN

STEP_TICKS = 4
"""How long loading a crate takes in ticks, and unloading it; its effects are applied in the middle."""


@contextmanager
def crashed(folder: Path, task: str, ticks: int) -> Iterator[CellHost]:
    """Open a cell again whose process has died after some ticks of a task: on a copy of what its disk had then."""
    write_yard(folder, takes_ms=20)
    with open_cell(find_settings(folder), SilentReporter()) as host:
        host.submit("first", OperationRequest(task=task))
        while host.loop.runs and host.loop.runs[0].state in ("queued", "planning"):
            if not host.tick():
                host.loop.wait(0.1)
        for _ in range(ticks):
            host.tick()
        shutil.copytree(folder / "state", folder / "image")
    settings = structs.replace(find_settings(folder), folder=str(folder / "image"))
    with open_cell(settings, SilentReporter()) as again:
        yield again


def ended(host: CellHost, operation: str) -> OperationStatus:
    with closing(JournalReader(host.settings.journal)) as reader:
        found = reader.find(operation)
    assert found is not None and found.ended is not None
    return found.ended


def calls(host: CellHost, operation: str) -> Counter[str]:
    """Return which calls of skills an operation began, with their crates."""
    with closing(JournalReader(host.settings.journal)) as reader:
        events = [each.event for each in reader.envelopes(operation)]
    return Counter(
        f"{each.skill} {each.bindings['crate']}" for each in events if isinstance(each, ImplementationChosen)
    )


def brought(host: CellHost) -> int:
    world = host.world.snapshot()
    return len(world.objects(world.vocabulary.expand("lab:Goal"), CONTAIN))


@pytest.mark.parametrize("decision", ["replan", "retry", "skip"])
@pytest.mark.parametrize("seed", range(2))
def test_a_plan_is_continued_from_any_moment(tmp_path: Path, seed: int, decision: str) -> None:
    ticks = Random(f"{seed} {decision}").randrange(2 * CRATES * STEP_TICKS - 1)
    with crashed(tmp_path, "carry_all", ticks) as host:
        first = ended(host, "first")
        assert first.state == "interrupted" and {"replan", "retry"} <= set(first.decisions)
        if decision not in first.decisions:
            pytest.skip("no step was running")
        why = "I carried it" if decision == "skip" else ""
        host.submit("second", OperationRequest(continues="first", decision=decision, why=why, owner="Ada"))  # type: ignore[arg-type]
        (second,) = run_all(host)
        assert second.state == "succeeded", second.failure
        assert second.request.task == "carry_all" and brought(host) == CRATES
        linked = ended(host, "first")
        assert (linked.continued_by, linked.decisions) == ("second", ())
        before, after = calls(host, "first"), calls(host, "second")
        assert sum((before & after).values()) <= (decision != "skip"), "only what was running"
        assert sum((before | after).values()) == 2 * CRATES


@pytest.mark.parametrize("ticks", [1, STEP_TICKS + 1, 2 * STEP_TICKS + 1])
def test_a_body_goes_on_with_the_step_that_was_running(tmp_path: Path, ticks: int) -> None:
    with crashed(tmp_path, "carry_two", ticks) as host:
        assert ended(host, "first").decisions == ("retry",)
        host.submit("second", OperationRequest(continues="first", decision="retry"))
        before = calls(host, "first")
        (second,) = run_all(host)
        after = calls(host, "second")
        assert second.state == "succeeded", second.failure
        assert sum((before & after).values()) <= 1 and sum((before | after).values()) == 4


def test_what_cannot_be_continued_is_refused(tmp_path: Path) -> None:
    def refuse(message: str, **fields: object) -> None:
        with pytest.raises(RequestError, match=message):
            host.submit("second", OperationRequest(**fields))  # type: ignore[arg-type]

    with crashed(tmp_path, "carry_all", 1) as host:
        refuse("there is no operation nothing", continues="nothing")
        refuse("what is to be done is that of first; leave out the task", continues="first", task="carry_all")
        refuse(r"say why the step counts as done \(`why`\)", continues="first", decision="skip")
        host.submit("second", OperationRequest(continues="first"))
        with pytest.raises(RequestError, match="first is being continued"):
            host.submit("third", OperationRequest(continues="first"))
        run_all(host)
        with pytest.raises(RequestError, match="first was continued by second"):
            host.submit("third", OperationRequest(continues="first"))
        with pytest.raises(RequestError, match="second has succeeded; only an operation that was interrupted"):
            host.submit("third", OperationRequest(continues="second"))
