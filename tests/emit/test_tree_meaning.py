"""A tree as BehaviorTree.CPP runs it does what the language means: the same words to each primitive in each tick."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence

import msgspec
from hypothesis import HealthCheck, event, given, settings

from emit.bt_parts import Blackboard, Outcome
from emit.bt_parts import Stage as Leaves
from emit.bt_player import Player
from skillc_compiler.emit import bt
from skillc_compiler.emit.bt.calls import may_break_hold
from skillc_model import tree
from skillc_model.conditions import Condition
from skillc_model.skills import Compound, SkillLibrary, Task
from skillc_model.traversal import walk
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.expressions import value_of
from skillc_runtime.world.state.changes import SetProperty
from tree.library import ON, here, world
from tree.stage import PERIOD_S, Script
from tree.strategies import Play, plays
from tree.test_against_reference import TICKS, by_reference

SLOW = [HealthCheck.too_slow, HealthCheck.data_too_large]
LEAVES = tree.Check | tree.WaitUntil | tree.Wait | tree.Call
EXAMPLES = int(os.environ.get("SKILLC_EXAMPLES", "20"))


class Scripted(Leaves):
    """Leaves that follow the scripts of a play, on a world of flags."""

    def __init__(self, play: Play) -> None:
        self.world = world()
        self.scripts, self.starts = play.scripts, dict.fromkeys(play.scripts, 0)
        self.log: list[tuple[float, str, str]] = []
        self.conditions = dict(conditions(play))
        self.calls = {str(each.source): each for each in walk(play.body) if isinstance(each, tree.Call)}

    def action(self, path: tuple[str, ...], values: Blackboard) -> Callable[[], Outcome | None]:
        name = str(values["name"])
        script = self.scripts[name][self.starts[name] % len(self.scripts[name])]
        self.starts[name] += 1
        self._tell("start", values)
        left = iter(range(script.ticks - 1, -1, -1))

        def step() -> Outcome | None:
            self._tell("tick", values)
            if next(left):
                return None
            if script.ending == "success" and "flag" in values and "value" in values:
                self.world.commit([SetProperty(str(values["flag"]), ON, bool(values["value"]))])
            if script.ending != "success":
                self._tell("halt", values)
            return Outcome(script.ending == "success")

        return step

    def halt(self, path: tuple[str, ...], values: Blackboard) -> None:
        self._tell("halt", values)

    def undo(self, path: tuple[str, ...], values: Blackboard) -> None:
        self._tell("release", values)

    def holds(self, path: tuple[str, ...], source: str, values: Blackboard) -> bool:
        if path[-1].startswith("still"):
            call = self.calls[source]
            bindings = {name: value_of(value, self.world.snapshot(), {}) for name, value in call.arguments.items()}
            return self.world.snapshot().value(str(bindings["flag"]), ON) == bindings["value"]
        return evaluate(self.conditions[source], self.world.snapshot(), values)  # type: ignore[arg-type]

    def _tell(self, what: str, values: Blackboard) -> None:
        self.log.append((self.now, what, str(values["name"])))


def conditions(play: Play) -> Iterator[tuple[str, Condition]]:
    """Yield every condition by its place."""
    bodies = [each.body.node for each in play.library.implementations.values() if isinstance(each.body, Compound)]
    for body in (play.body, *bodies):
        for each in walk(body):
            if isinstance(each, tree.Check | tree.WaitUntil | tree.If | tree.While):
                yield str(each.source), each.condition
    for skill in play.library.skills.values():
        yield from ((str(each.source), each.condition) for each in (*skill.pre, *skill.hold, *skill.post))


def comparable(play: Play) -> Play:
    """Return the play without what a tree cannot tell: how a start failed, locks, ties, what more keeps a result.

    Reactive nodes stay so if all but the last of their children only test: BehaviorTree.CPP starts one that comes
    before the one that runs first, and halts that one then.
    """
    scripts = {
        name: [Script("success" if each.ending == "success" else "fail", each.ticks) for each in several]
        for name, several in play.scripts.items()
    }
    skills = {name: msgspec.structs.replace(skill, uses=()) for name, skill in play.library.skills.items()}
    library = msgspec.structs.replace(play.library, skills=skills)
    implementations = {
        key: msgspec.structs.replace(each, body=Compound(plain(each.body.node, library)))
        if isinstance(each.body, Compound)
        else each
        for key, each in library.implementations.items()
    }
    library = msgspec.structs.replace(library, implementations=implementations)
    return Play(plain(play.body, library), library, scripts, play.switches, None)


def plain(node: tree.Node, library: SkillLibrary) -> tree.Node:
    """Return the node with what cannot be compared made simpler."""
    match node:
        case tree.Sequence(children=children, reactive=reactive):
            simple = only_tests(children[:-1]) and isinstance(children[-1], LEAVES)
            inner = tuple(plain(each, library) for each in children)
            return tree.Sequence(children=inner, reactive=reactive and simple, source=node.source)
        case tree.Selector(children=children, reactive=reactive):
            inner = tuple(plain(each, library) for each in children)
            return tree.Selector(children=inner, reactive=reactive and only_tests(children[:-1]), source=node.source)
        case tree.Parallel(policy=policy, children=children):
            inner = tuple(plain(each, library) for each in children)
            return msgspec.structs.replace(node, children=inner, policy="any" if policy == "race" else policy)
        case tree.Call(skill="Setup"):
            return msgspec.structs.replace(node, skill="Act")
        case tree.Once(child=child) if may_break_hold(library, child):
            return plain(child, library)
    parts = {name: getattr(node, name, None) for name in ("child", "handler", "last", "then", "orelse")}
    return msgspec.structs.replace(node, **{name: plain(each, library) for name, each in parts.items() if each})


def only_tests(nodes: Sequence[tree.Node]) -> bool:
    """Whether nodes only test conditions."""
    return all(isinstance(each, tree.Check | tree.WaitUntil) for each in nodes)


def by_player(play: Play, stage: Scripted) -> list[str]:
    """Return the status after each tick."""
    task = Task(name="play", body=play.body, source=here())
    player = Player(bt.emit(msgspec.structs.replace(play.library, tasks={"play": task}))["trees/task_play.xml"], stage)
    statuses: list[str] = []
    for number in range(TICKS):
        stage.now = number * PERIOD_S
        stage.world.commit([SetProperty(flag, ON, on) for tick, flag, on in play.switches if tick == number])
        outcome = player.tick()
        if outcome is not None:
            return [*statuses, "success" if outcome.ok else "failure"]
        statuses.append("running")
    player.root.halt()
    return [*statuses, "halted"]


@given(plays())
@settings(max_examples=EXAMPLES, suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large])
def test_a_tree_does_what_the_language_means(drawn: Play) -> None:
    play = comparable(drawn)
    expected = by_reference(play)
    stage = Scripted(play)
    assert by_player(play, stage) == expected.statuses
    assert sorted(stage.log) == sorted(expected.log)
    event(f"ended {expected.statuses[-1]}")
