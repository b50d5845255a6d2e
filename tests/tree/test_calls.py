"""Arguments, scopes, outputs and posts of calls."""

from __future__ import annotations

from typing import Any

import pytest

from skillc_model import tree
from skillc_model.conditions import Assign, Compare, Condition, Invoke, IsA, Not, PropertyOf, Variable
from skillc_model.conditions import Literal as Constant
from skillc_model.skills import Compound, Let, Parameter, Post, Skill
from skillc_model.skills import Primitive as PrimitiveBody
from skillc_rdf.vocabulary.types import ClassType
from skillc_runtime.execution.tree.run import TreeRun
from skillc_runtime.primitives.primitive import Primitive, Status
from skillc_runtime.world.state.changes import SetProperty
from tree.library import (
    FLAG,
    FLAGS,
    NAME,
    ON,
    TEXT,
    THE_FLAG,
    VALUE,
    WRITTEN,
    Library,
    act,
    call,
    here,
    is_on,
    parameter,
    requirement,
    seq,
    world,
)
from tree.stage import Script, Stage

OUT = parameter("word", TEXT, "out")


class Says(Primitive):
    """Assigns its output `word`: what it was told to say, nothing for an empty text, a number for "1"."""

    def __init__(self, cell: Stage, *, name: str) -> None:
        super().__init__(cell)  # type: ignore[arg-type]
        if name:
            self.outputs["word"] = 1.0 if name == "1" else f"{name}!"

    def tick(self) -> Status:
        return Status.SUCCESS


class Measures(Primitive):
    """Writes into the world itself."""

    def __init__(self, cell: Stage, *, flag: str, value: bool) -> None:
        super().__init__(cell)  # type: ignore[arg-type]
        self._change = SetProperty(flag, ON, value)

    def tick(self) -> Status:
        self.cell.world.commit([self._change], "measured", "sensed")
        return Status.SUCCESS


def run(body: tree.Node, library: Library, cell: Stage) -> TreeRun:
    """Run a body to its end."""
    result = TreeRun(body, library.build(), cell)
    for _ in range(30):
        if result.tick() is not Status.RUNNING:
            return result
        cell.now += 0.1
    raise AssertionError("the run does not end")


def with_out(skill: str, out: str, **arguments: Any) -> tree.Call:
    """Call a skill and name its output."""
    made = call(skill, **arguments)
    return tree.Call(skill=skill, implementation=None, arguments=made.arguments, out=out, source=here())


def read(skill: str, **variables: str) -> tree.Call:
    """Call a skill with variables as arguments."""
    arguments = {name: Variable(variable) for name, variable in variables.items()}
    return tree.Call(skill=skill, implementation=None, arguments=arguments, out=None, source=here())


def saying() -> Library:
    """Return a library with a skill that has an output."""
    library = Library()
    library.add(Skill(name="Say", parameters=(NAME, OUT), source=here()), PrimitiveBody("tree.test_calls:Says"))
    return library


def test_an_output_reaches_later_siblings() -> None:
    cell = Stage(world())
    body = seq(with_out("Say", "heard", name="hello"), read("Act", name="heard"))
    assert run(body, saying(), cell).status is Status.SUCCESS
    assert cell.said("start") == ["start hello!"]


def test_a_compound_hands_an_output_out() -> None:
    cell, library = Stage(world()), saying()
    compound = Skill(name="Relay", parameters=(NAME, OUT), source=here())
    say = tree.Call(skill="Say", implementation=None, arguments={"name": Variable("name")}, out="word", source=here())
    library.add(compound, Compound(say))
    assert run(seq(with_out("Relay", "it", name="yes"), read("Act", name="it")), library, cell).status is Status.SUCCESS
    assert cell.said("start") == ["start yes!"]


def test_an_output_that_is_missing_or_wrong_fails() -> None:
    missing = run(with_out("Say", "it", name=""), saying(), Stage(world()))
    assert missing.failure is not None and missing.failure.message == "Say succeeded without assigning `word`"
    wrong = run(with_out("Say", "it", name="1"), saying(), Stage(world()))
    assert wrong.failure is not None and wrong.failure.message == "output `word` needs Text, not 1"


def test_a_body_sees_only_its_own_scope() -> None:
    """The name `heard` of the caller is unknown inside the callee."""
    library = saying()
    library.add(Skill(name="Nosy", source=here()), Compound(read("Act", name="heard")))
    nosy = run(seq(with_out("Say", "heard", name="secret"), call("Nosy")), library, Stage(world()))
    assert nosy.failure is not None and nosy.failure.kind == "error" and "`heard`" in nosy.failure.message


def test_for_runs_the_child_once_for_each_item() -> None:
    cell = Stage(world())
    loop = tree.ForEach(variable="n", items=Invoke("names", ()), child=read("Act", name="n"), source=here())
    assert run(loop, Library(), cell).status is Status.SUCCESS
    assert cell.said("start") == ["start a", "start b", "start c"]


def test_loops_side_by_side_do_not_share_their_variable() -> None:
    cell = Stage(world(), {"a": [Script(ticks=2)]})
    loop = tree.ForEach(variable="n", items=Invoke("names", ()), child=read("Act", name="n"), source=here())
    both = tree.Parallel(
        policy="all", children=(loop, seq(tree.Wait(seconds=Constant(0.1), source=here()), loop)), source=here()
    )
    assert run(both, Library(), cell).status is Status.SUCCESS
    assert sorted(cell.said("start")) == ["start a", "start a", "start b", "start b", "start c", "start c"]


def test_what_the_last_round_assigned_is_kept_and_the_variable_is_not() -> None:
    cell = Stage(world())
    say = tree.Call(skill="Say", implementation=None, arguments={"name": Variable("n")}, out="last", source=here())
    loop = tree.ForEach(variable="n", items=Invoke("names", ()), child=say, source=here())
    assert run(seq(loop, read("Act", name="last")), saying(), cell).status is Status.SUCCESS
    assert cell.said("start") == ["start c!"]
    lost = run(seq(loop, read("Act", name="n")), saying(), Stage(world()))
    assert lost.failure is not None and lost.failure.kind == "error"


def inferring() -> Library:
    """Return a library with a skill that turns off the one flag that is on, inferred again at each start."""
    library = Library()
    found = Parameter(name="flag", direction="infer", type=ClassType(FLAG), any_=True, source=here())
    off = Post(
        label="off",
        condition=Not(is_on(Variable("flag"))),
        effects=(Assign(Variable("flag"), ON, Constant(False)),),
        sensed=False,
        text="flag.on == false",
        source=here(),
    )
    lit = requirement("lit", "flag.on == true", is_on(Variable("flag")))
    library.add(Skill(name="TurnOff", parameters=(NAME, found), pre=(lit,), post=(off,), source=here()))
    return library


def test_parameters_are_inferred_anew_in_each_round() -> None:
    cell = Stage(world())
    turn_off = call("TurnOff", name="x")
    assert run(tree.Repeat(count=3, child=turn_off, source=here()), inferring(), cell).status is Status.SUCCESS
    assert [cell.world.snapshot().value(flag, ON) for flag in FLAGS] == [False, False, False]
    again = run(turn_off, inferring(), cell)
    assert again.failure is not None and again.failure.kind == "inference"


def test_lets_are_computed_when_the_implementation_starts() -> None:
    cell, library = Stage(world()), saying()
    library.add(
        Skill(name="Once", source=here()), Compound(read("Act", name="mine")), lets=(Let("mine", Constant("m")),)
    )
    assert run(call("Once"), library, cell).status is Status.SUCCESS
    assert cell.said("start") == ["start m"]


def test_an_optional_parameter_that_was_not_passed_is_not_passed_on() -> None:
    cell, library = Stage(world()), Library()
    word = parameter("word", TEXT, "opt")
    library.add(Skill(name="Inner", parameters=(NAME, word), source=here()))
    inner = tree.Call(
        skill="Inner",
        implementation=None,
        arguments={"name": Constant("in"), "word": Variable("word")},
        out=None,
        source=here(),
    )
    library.add(Skill(name="Outer", parameters=(word,), source=here()), Compound(inner))
    assert run(call("Outer"), library, cell).status is Status.SUCCESS


def post(condition: Condition, sensed: bool) -> Post:
    """Make a post that only checks."""
    return Post(label="seen", condition=condition, effects=(), sensed=sensed, text="flag.on == value", source=here())


AS_MEASURED = Compare(PropertyOf(Variable("flag"), ON), "==", Variable("value"))


def measuring(python: str) -> Library:
    """Return a library with a skill whose post is sensed."""
    library = Library()
    skill = Skill(name="Measure", parameters=(THE_FLAG, VALUE), post=(post(AS_MEASURED, True),), source=here())
    library.add(skill, PrimitiveBody(python))
    return library


class Blind(Measures):
    """Measures nothing."""

    def tick(self) -> Status:
        return Status.SUCCESS


def test_a_sensed_post_is_checked_and_never_written() -> None:
    body = call("Measure", flag=FLAGS[0], value=False)
    assert run(body, measuring("tree.test_calls:Measures"), Stage(world())).status is Status.SUCCESS
    cell = Stage(world())
    blind = run(body, measuring("tree.test_calls:Blind"), cell)
    assert blind.failure is not None and blind.failure.kind == "post"
    assert "post `seen: flag.on == value` does not hold for flag = stage:flag0, value = false" in blind.failure.message
    assert cell.world.snapshot().value(FLAGS[0], ON) is True


def compound(*children: tree.Node) -> Library:
    """Return a library with a compound that promises to set a flag."""
    library = Library()
    skill = Skill(name="Promise", parameters=(THE_FLAG, VALUE), post=(WRITTEN,), source=here())
    library.add(skill, Compound(seq(*children)))
    return library


def test_the_post_of_a_compound_is_only_checked() -> None:
    body, cell = call("Promise", flag=FLAGS[0], value=False), Stage(world())
    broken = run(body, compound(act("a")), cell)
    assert broken.failure is not None and broken.failure.kind == "post"
    assert cell.world.snapshot().value(FLAGS[0], ON) is True


def test_apply_writes_a_post_of_the_compound() -> None:
    body, cell = call("Promise", flag=FLAGS[0], value=False), Stage(world())
    applied = compound(act("a"), tree.Apply(labels=("written",), source=here()))
    assert run(body, applied, cell).status is Status.SUCCESS
    assert cell.world.snapshot().value(FLAGS[0], ON) is False


@pytest.mark.parametrize("ending", ["fail", "crash", "refuse"])
def test_what_did_not_succeed_writes_nothing(ending: Any) -> None:
    cell = Stage(world(), {"a": [Script(ending)]})
    before = cell.world.snapshot()
    assert run(call("Set", name="a", flag=FLAGS[0], value=False), Library(), cell).status is Status.FAILURE
    assert cell.world.snapshot() is before


def test_what_a_scoped_skill_wrote_is_taken_back_when_its_scope_ends() -> None:
    cell, library = Stage(world()), Library()
    library.add(Skill(name="Dim", parameters=(NAME, THE_FLAG, VALUE), post=(WRITTEN,), scoped=True, source=here()))
    off = call("Dim", name="dim", flag=FLAGS[0], value=False)
    inside = tree.Check(condition=Not(is_on(Variable("flag"))), text="not flag.on == true", source=here())
    library.add(Skill(name="InTheDark", parameters=(THE_FLAG,), source=here()), Compound(inside))
    body = tree.With(call=off, child=call("InTheDark", flag=FLAGS[0]), source=here())
    assert run(body, library, cell).status is Status.SUCCESS
    assert cell.world.snapshot().value(FLAGS[0], ON) is True
    assert cell.said("release") == ["release dim"]


def test_a_write_that_the_world_refuses_fails_the_skill() -> None:
    library = Library()
    wrong = Post(
        label="wrong",
        condition=IsA(Variable("flag"), FLAG),
        effects=(Assign(Variable("flag"), ON, Constant("no truth value")),),
        sensed=False,
        text="flag.on == ..",
        source=here(),
    )
    library.add(Skill(name="Lie", parameters=(NAME, THE_FLAG), post=(wrong,), source=here()))
    cell = Stage(world())
    lie = run(call("Lie", name="a", flag=FLAGS[0]), library, cell)
    assert lie.failure is not None and lie.failure.kind == "error" and lie.failure.skill == "Lie"
    assert cell.world.snapshot().value(FLAGS[0], ON) is True
