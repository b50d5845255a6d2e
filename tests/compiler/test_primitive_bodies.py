"""What the text of a primitive says of its `tick` and of its outputs, and what it leaves open."""

from __future__ import annotations

from pathlib import Path
from textwrap import indent

import pytest
from shipped import shelf, vocabulary

from skillc_compiler.pipeline import compile
from skillc_compiler.python.targets import Targets
from skillc_dsl.source import Source

HEAD = """
import sys
from enum import Enum
from contextlib import suppress
from skillc.primitives import Primitive, SkillFailure, Status

class Phase(Enum):
    DONE = 1

def give_up():
    raise SkillFailure("it is over")

class Base(Primitive):
    def fail_now(self, why):
        if why:
            raise SkillFailure(why)
        else:
            give_up()

class Own(Base):
    def __init__(self, cell, *, part):
        super().__init__(cell)

"""
GOOD = (
    "if self.cell.now > 3:\n    return Status.SUCCESS\nreturn Status.RUNNING",
    "if self.cell.now > 3:\n    return Status.SUCCESS\nelse:\n    give_up()",
    "while True:\n    if self.cell.now > 3:\n        return Status.SUCCESS\n    for part in ():\n        break",
    "try:\n    return self.look()\nexcept ValueError as error:\n    raise SkillFailure(str(error)) from None",
    "if self.cell.now > 3:\n    self.fail_now('late')\nelse:\n    return Status.RUNNING",
    "match self.cell.now:\n    case 1.0:\n        return Status.RUNNING\n    case _:\n        sys.exit(1)",
    "with self.lock:\n    return Status.RUNNING",
    "return super().tick()",
    "return Status.SUCCESS if self.cell.now > 3 else Status.RUNNING",
    "def helper():\n    return 3\nreturn self.found(helper)",
    "to = None\nif self.cell.now > 3:\n    to = Status.SUCCESS\nelse:\n    to = Status.RUNNING\nreturn to",
    "to = Status.FAILURE\nif to is self.ended:\n    raise SkillFailure('over')\nreturn self.ended",
    "match self.phase:\n    case Phase.DONE:\n        return Status.SUCCESS",
    "to = Status.RUNNING if self.left else Status.SUCCESS\nreturn to",
    "return self.step()\ndef step(self):\n    return self.ended or Status.RUNNING",
)
BAD = (
    ("if self.cell.now > 3:\n    return Status.SUCCESS", "can end without `return`", 0),
    ("while self.cell.now < 3:\n    return Status.RUNNING", "can end without `return`", 0),
    ("while True:\n    if self.cell.now > 3:\n        break\n    return Status.RUNNING", "can end without `return`", 0),
    ("try:\n    return Status.RUNNING\nexcept ValueError:\n    pass", "can end without `return`", 0),
    ("with suppress(ValueError):\n    return Status.RUNNING", "can end without `return`", 0),
    ("if self.cell.now > 3:\n    return\nreturn Status.RUNNING", "returns nothing", 1),
    ("return True", "returns `True`", 0),
    ("return self.cell.now > 3", "returns `self.cell.now > 3`", 0),
    ("return Status.SUCCESS if self.cell.now > 3 else None", "returns `None`", 0),
    ("x = 1\nreturn Status.FAILURE", "returns `Status.FAILURE`", 1),
    ("yield Status.RUNNING", "is a generator", -1),
    ("while True:\n    self.moved = 1", "never returns, as it has a loop without end", 0),
    ("ended = self.cell.now > 3\nreturn ended", "returns `ended`, which is `self.cell.now > 3`", 1),
    ("to = Status.RUNNING\nif self.moved:\n    to = Status.FAILURE\nreturn to", "which is `Status.FAILURE`", 3),
    ("return self.cell.now > 3 and Status.SUCCESS", "which may be `False`", 0),
    ("return Status", "returns the class `Status`", 0),
    ("return Phase.DONE", "returns `Phase.DONE`", 0),
    ("match self.left:\n    case 0:\n        return Status.SUCCESS", "can end without `return`", 0),
    ("return self.step()\ndef step(self):\n    self.moved = 1", "returns `self.step()`, and `step` can end", 2),
)


def inside(body: str) -> str:
    """Write the lines of a method, and a method after them."""
    lines, method, after = body.partition("def step")
    return indent(lines, " " * 8) + indent(method + after, " " * 4)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a folder from which Python imports."""
    monkeypatch.syspath_prepend(str(tmp_path))
    return tmp_path


def test_good_ticks_have_nothing_wrong(folder: Path) -> None:
    for number, body in enumerate(GOOD):
        (folder / f"good{number}.py").write_text(f"{HEAD}    def tick(self) -> Status:\n{inside(body)}\n")
        contract = Targets().contract(f"good{number}", "Own")
        assert contract.place is not None and contract.breach is None, body


def test_what_a_tick_does_wrong_is_found_where_it_does_it(folder: Path) -> None:
    first = HEAD.count("\n") + 2
    for number, (body, what, line) in enumerate(BAD):
        (folder / f"bad{number}.py").write_text(f"{HEAD}    def tick(self):\n{inside(body)}\n")
        breach = Targets().contract(f"bad{number}", "Own").breach
        assert breach is not None and what in breach.what, body
        assert (breach.path, breach.line) == (str(folder / f"bad{number}.py"), first + line), body


def test_a_wrong_annotation_and_an_inherited_tick_are_read(folder: Path) -> None:
    tick = "    def tick(self) -> bool:\n        return self.moved\n"
    (folder / "inherited.py").write_text(f"{HEAD}{tick}\nclass Inheritor(Own):\n    moved = 1\n")
    breach = Targets().contract("inherited", "Inheritor").breach
    assert breach is not None and breach.what == "is annotated to return `bool`"


TO_SET = 'set `self.outputs["weight"]` before it returns `Status.SUCCESS`'


@pytest.mark.parametrize(
    ("written", "told"),
    [
        ('self.outputs["weight"] = 1.0', []),
        ("self.outputs = {'weight': 1.0}", []),
        ("self.outputs.update(weight=1.0)", []),
        ("self.outputs[self.name] = 1.0", []),
        ("self.fill(self.outputs)", []),
        ("fill(self)", []),
        ("pass", ['set `self.outputs["weight"]` before it returns `Status.SUCCESS`']),
        ('self.outputs["wieght"] = 1.0', ["did you mean `wieght`?"]),
        ('self.outputs["weight"] = "heavy"', ["`weight` is a Mass"]),
        ("self.outputs = {'weight': None}", ["`weight` is a Mass"]),
        ("self.outcome, self.outputs = 'heavy', {'weight': 1.0}", []),
        (
            'self.found = self.outputs.get("weight")',
            ['set `self.outputs["weight"]` before it returns `Status.SUCCESS`'],
        ),
    ],
)
def test_an_output_that_is_never_set_is_told_where_it_is_declared(folder: Path, written: str, told: list[str]) -> None:
    name = f"outputs{abs(hash(written))}"
    (folder / f"{name}.py").write_text(f"{HEAD}    def tick(self):\n        {written}\n        return Status.SUCCESS\n")
    text = f"""use skiros
skill Look {{ in part: Product  out weight: Mass  noplan }}
impl own of Look {{ run python "{name}:Own" }}
"""
    found = compile([Source("a.skill", text)], vocabulary(), shelf(), "own").diagnostics
    assert [(each.name, each.span.line, each.help) for each in found] == [
        ("broken-contract", 3, help_) for help_ in told
    ]


def test_an_outcome_that_there_is_not_and_a_constructor_that_is_left_out_are_told(folder: Path) -> None:
    own = "class Sees(Base):\n    def __init__(self, cell, *, part):\n        self.part = part\n"
    tick = '    def tick(self):\n        self.outcome = "god"\n        return Status.SUCCESS\n'
    (folder / "sees.py").write_text(f"{HEAD}        pass\n\n{own}{tick}")
    text = """use skiros
skill Look { in part: Product  outcome good: part.Weight == 1 kg  outcome bad: part.Weight == 2 kg  noplan }
impl own of Look { run python "sees:Sees" }
"""
    sources = [Source("a.skill", text)]
    found = compile(sources, vocabulary(), shelf(), "own", {}).diagnostics
    assert {each.help for each in found if each.name == "broken-contract"} == {
        "call `super().__init__(cell)` in it",
        "did you mean `good`?",
    }
