"""A call waits for what others use: in the order of arrival, all at once or not at all, and not in a circle."""

from __future__ import annotations

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from skillc_model import tree
from skillc_model.conditions import Literal
from skillc_model.skills import PausePolicy, Skill
from skillc_runtime.execution.device_claims import ClaimedLocks, DeviceClaims
from skillc_runtime.execution.tree.gate import Gate
from skillc_runtime.execution.tree.locks import DeviceLocks, LockTable
from skillc_runtime.execution.tree.run import TreeRun
from skillc_runtime.primitives.primitive import Status
from skillc_runtime.recording.events import Event, Note
from skillc_runtime.recording.run_spec import RunSpec
from skillc_runtime.world.state.changes import SetProperty
from tree.library import DEVICES, FLAGS, NAME, ON, THE_DEVICE, Library, act, call, here, par, seq, world
from tree.stage import PERIOD_S, Script, Stage, stage
from tree.strategies import Play, plays

A, B, C = DEVICES
LONG = Script(ticks=1000)


def use(name: str, device: str = A) -> tree.Call:
    return call("Use", name=name, device=device)


def tick(cell: Stage, *runs: TreeRun, times: int = 1) -> None:
    """Tick all runs that go on, and let time pass."""
    for _ in range(times):
        for run in runs:
            run.tick()
        cell.now += PERIOD_S


def timeout(seconds: float, child: tree.Node) -> tree.Node:
    return tree.Timeout(seconds=Literal(seconds), child=child, source=here())


def circle(library: Library, *devices: str) -> list[tree.Call]:
    """Return calls that each use a device, and after one tick the next one's."""
    following = zip(devices, (*devices[1:], devices[0]), strict=True)
    return [
        call(library.using(seq(act(f"first {n}"), use(f"then {n}", after))), device=own)
        for n, (own, after) in enumerate(following)
    ]


def test_siblings_use_a_device_one_after_the_other_and_say_for_what_they_wait() -> None:
    cell, library, events = stage(a=Script(ticks=2), b=Script(ticks=2)), Library(), list[Event]()
    using = call(library.using(use("a")), device=A)
    run = TreeRun(par("all", using, use("b"), use("c")), library.build(), cell, [events.append])
    tick(cell, run)
    assert run.waits_for == "; ".join(["Use waits for stage:device0, which Use uses"] * 2)
    tick(cell, run)
    assert run.waits_for == "Use waits for stage:device0, which Use uses"
    tick(cell, run)
    assert (run.status, run.waits_for) == (Status.SUCCESS, "")
    order = ["start a", "tick a", "tick a", "start b", "tick b", "tick b", "start c", "tick c"]
    assert cell.said() == order
    notes = [each.message for each in events if isinstance(each, Note)]
    assert notes == ["Use waits for stage:device0, which Use uses"] * 2


def test_nobody_overtakes_who_waits_longer_for_one_of_two_things() -> None:
    """The first call holds a; the second one wants a and b; the third wants b, and does not get it before."""
    locks, calls = DeviceLocks(LockTable()), [Use() for _ in range(3)]
    assert locks.acquire((A,), calls[0], ()) is None
    assert locks.acquire((A, B), calls[1], ()) is not None and locks.wait(calls[1], ((A, B),), ()) == ()
    assert locks.held == {A}
    conflict = locks.acquire((B,), calls[2], ())
    assert conflict is not None and (conflict.individual, conflict.user.call, conflict.held) == (B, calls[1], False)
    locks.wait(calls[2], ((B,), (C,)), ())
    assert locks.is_free(calls[2]) and not locks.is_free(calls[1])
    locks.release(calls[0])
    assert locks.is_free(calls[1])


class Use:
    """A call as locks see it."""

    skill_name, id, source = "Use", 0, here()


@pytest.mark.parametrize("devices", [(A, B), (A, B, C)])
def test_a_circle_fails_at_once_and_names_all_who_wait_and_for_what(devices: tuple[str, ...]) -> None:
    cell, library = stage(**{f"first {n}": Script(ticks=2) for n in range(3)}), Library()
    calls = circle(library, *devices)
    run = TreeRun(par("all", *calls), library.build(), cell)
    tick(cell, run)
    assert run.status is Status.RUNNING
    tick(cell, run)
    assert run.failure is not None and run.failure.kind == "lock"
    message = run.failure.message
    assert message.startswith(
        "a circle of waits: Use waits for stage:device0, which Using9 uses; in it, Use waits for "
    )
    for device, each in zip(("device0", "device1", "device2"), calls, strict=False):
        assert f"stage:{device}, which {each.skill} uses" in message
    assert message.endswith(f"; and Use is in {calls[-1].skill}")
    assert cell.said("start") == [f"start first {n}" for n in range(len(devices))]


def test_who_goes_on_in_what_another_one_waits_for_overtakes_it() -> None:
    locks, outer, both, inner = DeviceLocks(), Use(), Use(), Use()
    assert locks.acquire((A,), outer, ()) is None and locks.wait(both, ((A, B),), ()) == ()
    assert locks.find_conflict((B,), inner, ()) is not None
    assert locks.acquire((B,), inner, (outer,)) is None


def test_who_waits_can_be_stopped_and_timed_out() -> None:
    cell, locks = stage(a=LONG), DeviceLocks()
    run = TreeRun(par("all", use("a"), timeout(0.2, use("b"))), Library().build(), cell, locks=locks)
    tick(cell, run, times=4)
    assert run.failure is not None and (run.failure.kind, run.failure.message[:25]) == (
        "timeout",
        "Use was not done after 0.",
    )
    assert not locks.held and not locks.table.waits
    other = TreeRun(par("all", use("a"), use("b")), Library().build(), cell, locks=locks)
    tick(cell, other)
    other.halt("enough")
    assert other.status is Status.HALTED and not locks.held and not locks.table.waits
    assert cell.said("start", "halt") == ["start a", "halt a"] * 2


def test_the_deadline_of_each_step_ends_a_wait() -> None:
    cell = stage(a=LONG)
    locks = DeviceLocks()
    holder = TreeRun(use("a"), Library().build(), cell, locks=locks)
    late = TreeRun(use("b"), Library().build(), cell, locks=locks, spec=RunSpec(step_deadline_s=0.3))
    tick(cell, holder, late, times=5)
    assert late.failure is not None and late.failure.kind == "timeout"
    assert holder.status is Status.RUNNING


def test_a_paused_run_keeps_its_place_and_goes_on_afterwards() -> None:
    cell, locks = stage(a=Script(ticks=3)), DeviceLocks()
    one, two = (TreeRun(use(name), Library().build(), cell, locks=locks) for name in "ab")
    tick(cell, one, two)
    two.pause()
    tick(cell, one, two, times=4)
    assert one.status is Status.SUCCESS and cell.said("start") == ["start a"]
    two.resume()
    tick(cell, one, two)
    assert two.status is Status.SUCCESS


def test_who_waits_hinders_no_pause_and_does_not_start_during_one() -> None:
    cell, library, gate = stage(a=Script(ticks=3), c=Script(ticks=6)), Library(), Gate()
    careful = Skill(
        name="Careful", parameters=(NAME, THE_DEVICE), uses=("device",), pause=PausePolicy("never"), source=here()
    )
    library.add(careful)
    body = par("all", use("a"), call("Careful", name="b", device=A), act("c"))
    run = TreeRun(body, library.build(), cell, gate=gate)
    tick(cell, run)
    assert gate.find_hindrance(run.active_calls) is None
    gate.close("look")
    tick(cell, run, times=4)
    assert cell.said("start") == ["start a", "start c"] and len(gate.waiting) == 1
    gate.open()
    tick(cell, run)
    assert run.status is Status.SUCCESS and cell.said("start")[2:] == ["start b"]


def claimed(claims: DeviceClaims, *runs: str) -> list[ClaimedLocks]:
    """Return the locks of runs in a cell of which the last device is no robot."""
    claims.order(runs)
    return [ClaimedLocks(claims, run, lambda each: each != C) for run in runs]


def test_operations_wait_for_each_other_and_give_back_what_is_no_device() -> None:
    cell, claims, library = stage(a=Script(ticks=2), b=LONG, c=Script(ticks=2)), DeviceClaims(), Library().build()
    bodies = seq(use("a", C), use("b", A)), seq(use("c", C), use("d", A))
    locks = claimed(claims, "one", "two")
    one, two = (TreeRun(body, library, cell, locks=each) for body, each in zip(bodies, locks, strict=True))
    tick(cell, one, two)
    assert two.waits_for == "Use waits for stage:device2, which Use of one uses"
    assert one.waits_for == ""
    tick(cell, one, two, times=3)
    assert cell.said("start") == ["start a", "start b", "start c"]
    assert two.waits_for == "Use waits for stage:device0, which one uses"
    one.halt("enough")
    tick(cell, two)
    assert two.status is Status.RUNNING
    claims.remove("one")
    tick(cell, two)
    assert two.status is Status.SUCCESS


def test_a_circle_of_two_operations_fails_the_one_that_closes_it() -> None:
    cell, claims, library = stage(a=Script(ticks=2), b=Script(ticks=2)), DeviceClaims(), Library()
    first, second = seq(use("a", A), use("c", B)), seq(use("b", B), use("d", A))
    runs = [
        TreeRun(body, library.build(), cell, locks=each)
        for body, each in zip((first, second), claimed(claims, "one", "two"), strict=True)
    ]
    tick(cell, *runs, times=3)
    failure = runs[1].failure
    assert runs[0].status is Status.RUNNING and failure is not None
    assert failure.message == (
        "a circle of waits: Use waits for stage:device0, which one uses; "
        "in it, Use of one waits for stage:device1, which two uses; and Use is in two"
    )
    claims.remove("two")
    tick(cell, *runs, times=2)
    assert runs[0].status is Status.SUCCESS


@given(st.lists(plays(size=8, crowded=True), min_size=2, max_size=3))
@settings(max_examples=6, suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large])
def test_of_runs_that_share_devices_nobody_waits_for_ever(several: list[Play]) -> None:
    table = LockTable()
    stages = [Stage(world(), each.scripts) for each in several]
    runs = [
        TreeRun(each.body, each.library, own, locks=DeviceLocks(table, f"run-{n}"))
        for n, (each, own) in enumerate(zip(several, stages, strict=True))
    ]
    for number in range(1000):
        for own, run in zip(stages, runs, strict=True):
            own.now = number * PERIOD_S
            if number % 7 == 0:
                own.world.commit([SetProperty(flag, ON, number % 2 == 1) for flag in FLAGS])
            run.tick()
        if not any(run.status is Status.RUNNING for run in runs):
            break
    assert [run.waits_for for run in runs if run.status is Status.RUNNING] == []
    assert not table.waits and not table.users
