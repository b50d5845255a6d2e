"""What a primitive is told, and that everything is given back, whatever breaks."""

from __future__ import annotations

import itertools

import pytest

from skillc_model import tree
from skillc_model.skills import Compound, Skill
from skillc_runtime.devices.backend import DeviceStop
from skillc_runtime.devices.device_states import DeviceStates
from skillc_runtime.execution.tree.locks import DeviceLocks
from skillc_runtime.execution.tree.run import TreeRun
from skillc_runtime.primitives.primitive import SkillFailure, Status
from skillc_runtime.world.state.changes import SetProperty
from tree.library import DEVICES, FLAGS, ON, Library, act, call, here, par, seq, with_, world
from tree.stage import PERIOD_S, Script, Scripted, Stage, stage

LONG = Script(ticks=1000)


def finish(run: TreeRun, stage: Stage, ticks: int = 20) -> Status:
    """Tick until the run ends."""
    for _ in range(ticks):
        if run.tick() is not Status.RUNNING:
            return run.status
        stage.now += PERIOD_S
    raise AssertionError("the run does not end")


def test_halts_come_once_and_in_reverse_order_of_start() -> None:
    cell = stage(a=LONG, b=LONG, c=LONG)
    run = TreeRun(par("all", act("a"), seq(act("x"), act("b")), act("c")), Library().build(), cell)
    run.tick()
    run.halt("enough")
    run.halt("enough, really")
    assert cell.said("halt") == ["halt c", "halt b", "halt a"]
    assert run.status is Status.HALTED
    assert run.failure is not None and (run.failure.kind, run.failure.message) == ("halted", "enough")


def test_an_exception_halts_the_siblings_and_the_one_that_raised() -> None:
    cell = stage(a=LONG, b=Script("crash", 2), c=LONG)
    run = TreeRun(par("all", act("a"), act("b"), act("c")), Library().build(), cell)
    assert finish(run, cell) is Status.FAILURE
    assert cell.said("halt") == ["halt b", "halt c", "halt a"]
    assert run.failure is not None and run.failure.kind == "error"
    assert run.failure.message.startswith("RuntimeError: b broke (stage.py:")


def test_a_primitive_that_exits_fails_and_ends_nothing_else() -> None:
    cell = stage(a=LONG, b=Script("exit", 2))
    run = TreeRun(par("all", act("a"), act("b")), Library().build(), cell)
    assert finish(run, cell) is Status.FAILURE
    assert cell.said("halt") == ["halt b", "halt a"]
    assert run.failure is not None and run.failure.message.startswith("SystemExit: 0 (stage.py:")


def test_what_succeeded_or_refused_to_start_is_not_halted() -> None:
    cell = stage(a=Script("success", 2), b=Script("refuse"))
    run = TreeRun(seq(act("a"), act("b")), Library().build(), cell)
    assert finish(run, cell) is Status.FAILURE
    assert cell.said("halt") == []


def test_what_failed_by_itself_is_halted_then_undone() -> None:
    cell = stage(a=Script("success", 2), b=Script("fail", 3))
    run = TreeRun(par("all", act("a"), call("Setup", name="b")), Library().build(), cell)
    assert finish(run, cell) is Status.FAILURE
    assert cell.said("halt", "release") == ["halt b", "release b"]


FAULTS = ("start", "tick", "halt", "release", "pause", "withdraw", "approach", "resume")


class Faulty(Scripted):
    """Raises where its name says: `start SkillFailure`; otherwise as scripted."""

    def start(self) -> None:
        super().start()
        self._fault("start")

    def tick(self) -> Status:
        self._fault("tick")
        return super().tick()

    def halt(self, reason: str) -> None:
        super().halt(reason)
        self._fault("halt")

    def release(self) -> None:
        super().release()
        self._fault("release")

    def pause(self) -> None:
        self._fault("pause")

    def withdraw(self) -> None:
        self._fault("withdraw")

    def approach(self) -> bool:
        self._fault("approach")
        return True

    def resume(self) -> None:
        self._fault("resume")

    def _fault(self, where: str) -> None:
        place, _, kind = self.name.partition(" ")
        if place == where:
            raise {"SkillFailure": SkillFailure, "RuntimeError": RuntimeError}[kind](f"fault in {where}")


@pytest.mark.parametrize(("where", "kind"), [*itertools.product(FAULTS, ("SkillFailure", "RuntimeError"))])
@pytest.mark.parametrize("exit_by", ["success", "fail", "halt"])
@pytest.mark.parametrize("faulty", ["outer", "inner", "body"])
def test_scopes_are_undone_whatever_raises(where: str, kind: str, exit_by: str, faulty: str) -> None:
    """Everything that was set up is released once, the last first, and nothing stays locked or running."""
    names = {"outer": "outer", "inner": "inner", "body": "body"} | {faulty: f"{where} {kind}"}
    ending = Script("fail" if exit_by == "fail" else "success", 3)
    cell, locks = Stage(world(), {names["body"]: [ending]}), DeviceLocks()
    body = with_(names["inner"], call("Use", name=names["body"], device=DEVICES[0]))
    run = TreeRun(with_(names["outer"], body), Library("tree.test_lifecycle:Faulty").build(), cell, locks=locks)
    run.tick()
    if where in ("pause", "withdraw", "approach", "resume"):
        run.pause()
        run.withdraw()
        run.resume()
        run.tick()
    if exit_by == "halt":
        run.halt("enough")
    finish(run, cell)
    set_up = [name for name in (names["outer"], names["inner"]) if f"start {name}" in cell.said()]
    if (where, kind) == ("start", "SkillFailure") and faulty != "body":
        set_up.remove(names[faulty])
    assert cell.said("release") == [f"release {name}" for name in reversed(set_up)]
    assert len(set(cell.said("start", "halt"))) == len(cell.said("start", "halt"))
    assert not locks.held


def test_an_undo_that_raises_fails_the_scope_and_the_others_are_undone() -> None:
    cell = stage()
    library = Library("tree.test_lifecycle:Faulty").build()
    run = TreeRun(with_("outer", with_("release RuntimeError", act("body"))), library, cell)
    assert finish(run, cell) is Status.FAILURE
    assert run.failure is not None and "could not be undone: RuntimeError: fault in release" in run.failure.message
    assert cell.said("release") == ["release release RuntimeError", "release outer"]


class Interrupting(Scripted):
    """Is interrupted from the keyboard while it ticks."""

    def tick(self) -> Status:
        super().tick()
        raise KeyboardInterrupt


def test_an_interrupt_leaves_everything_to_be_halted() -> None:
    cell, locks = stage(), DeviceLocks()
    run = TreeRun(
        call("Use", name="a", device=DEVICES[0]), Library("tree.test_lifecycle:Interrupting").build(), cell, (), locks
    )
    with pytest.raises(KeyboardInterrupt):
        run.tick()
    assert locks.held == {DEVICES[0]}
    run.halt("interrupted")
    assert cell.said() == ["start a", "tick a", "halt a"] and not locks.held


def test_what_is_set_up_outside_a_scope_lasts_until_the_run_ends() -> None:
    cell = stage()
    run = TreeRun(seq(call("Setup", name="a"), call("Setup", name="b"), act("c")), Library().build(), cell)
    assert finish(run, cell) is Status.SUCCESS
    assert cell.said("start", "release") == ["start a", "start b", "start c", "release b", "release a"]


def test_a_scoped_compound_is_undone_as_a_whole_when_its_scope_ends() -> None:
    cell, library = stage(), Library()
    both = seq(call("Setup", name="a"), call("Setup", name="b"))
    library.add(Skill(name="Both", scoped=True, source=here()), Compound(both))
    run = TreeRun(seq(tree.With(call=call("Both"), child=act("c"), source=here()), act("d")), library.build(), cell)
    assert finish(run, cell) is Status.SUCCESS
    assert cell.said("start", "release") == ["start a", "start b", "start c", "release b", "release a", "start d"]


def test_a_broken_hold_is_not_hidden_and_names_the_facts() -> None:
    cell = stage(a=LONG)
    kept = call("Kept", name="a", flag=FLAGS[1])
    run = TreeRun(tree.Try(child=kept, source=here()), Library().build(), cell)
    run.tick()
    cell.world.commit([SetProperty(FLAGS[1], ON, False)])
    assert run.tick() is Status.FAILURE
    assert cell.said() == ["start a", "tick a", "halt a"]
    assert run.failure is not None and (run.failure.kind, run.failure.skill) == ("hold", "Kept")
    assert run.failure.message == (
        "hold `lit: flag.on == true` does not hold for flag = stage:flag1: stage:flag1.on is false; needed: true"
    )


def test_a_device_that_stopped_is_the_reason_why_its_call_fails_and_why_the_next_one_does_not_start() -> None:
    cell, why = stage(a=LONG), "arm: it touched the table with 80 N"
    uses = [TreeRun(call("Drive", name="a", device=DEVICES[0]), Library().build(), cell) for _ in range(2)]
    uses[0].tick()
    DeviceStates(cell.world, DEVICES).note(DeviceStop("protective-stop", why, DEVICES[:1]))
    for run in uses:
        assert run.tick() is Status.FAILURE and run.failure is not None
        assert (run.failure.kind, run.failure.message) == ("hold", why)
        assert run.failure.detail.startswith("hold `ready: device.deviceState != Fault` does not hold")
