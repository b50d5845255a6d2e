"""Python that a skill or function names: what its text tells is found by `check`, the rest before anything moves."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from skillc.cli.main import skillc
from skillc_dsl.position import Position
from skillc_model.skills import Parameter
from skillc_rdf.vocabulary.types import PlainType
from skillc_runtime.execution.selection.python_targets import PrimitiveError, check_function, import_matching_primitive

HEAD = """\
import dataclasses, functools
from dataclasses import KW_ONLY, dataclass, field
from typing import Any, Generic, TypeVar
import skillc_runtime.primitives.primitive as module
from skillc_runtime.primitives.primitive import Primitive, Status

T = TypeVar("T")
def unknown(cls): return cls
class Good(Primitive):
    def __init__(self, cell, *, arm, pace): super().__init__(cell)
    def tick(self): return Status.SUCCESS
class Other(Good):
    def __init__(self, cell, arm, *, speed): super().__init__(cell, arm=arm, pace=speed)
class Ticking(module.Primitive, Generic[T]):
    def tick(self): return Status.SUCCESS
"""
SUPER = "super().__init__(cell)"
TICK = "\n    def tick(self): return Status.SUCCESS"
FITTING = {
    "inherited": "class It(Good): pass",
    "by position": f"class It(Primitive):\n    def __init__(self, cell, arm, pace, more=1): {SUPER}{TICK}",
    "anything": f"class It(Primitive):\n    def __init__(self, cell, **rest): {SUPER}{TICK}",
    "rest passed on": "class It(Good):\n"
    "    def __init__(self, cell, *, pace, **rest): super().__init__(cell, pace=pace, **rest)",
    "mixin": "class Mixin:\n    def __init__(self, cell, **rest): super().__init__(cell, **rest)\n"
    "class It(Mixin, Good): pass",
    "dataclass": "@dataclass\nclass It(Primitive):\n    cell: Any\n    arm: str\n    _: KW_ONLY\n    pace: float\n"
    f"    left: list = field(init=False){TICK}",
    "alias": "It = Good",
    "tick of another": f"class It(Primitive):\n    def __init__(self, cell, *, arm, pace): {SUPER}"
    "\n    tick = Good.tick",
    "bound in a branch": "try:\n    from nowhere import It\nexcept ImportError:\n    It = Good",
}
TOLD = {
    "other names": ("It = Other", "takes no `pace`"),
    "inherited other names": ("class It(Other): pass", "takes no `pace`"),
    "none": ("class It(Ticking[int]): pass", "takes no `arm`, `pace`"),
    "additional": (
        f"class It(Primitive):\n    def __init__(self, cell, *, arm, pace, mass): ...{TICK}",
        "needs `mass`",
    ),
    "by position only": (
        f"class It(Primitive):\n    def __init__(self, cell, arm, pace, /): ...{TICK}",
        "by position only",
    ),
    "no names": (f"class It(Primitive):\n    def __init__(self, *values): ...{TICK}", "takes no `arm`, `pace`"),
    "no cell": (f"class It(Primitive):\n    def __init__(self, *, arm, pace): ...{TICK}", "takes no cell"),
    "needed beside the rest": (
        f"class It(Primitive):\n    def __init__(self, cell, *, mass, **rest): ...{TICK}",
        "needs `mass`",
    ),
    "dataclass": (
        f"@dataclasses.dataclass\nclass It(Primitive):\n    cell: Any\n    arm: str\n    mass: float{TICK}",
        "takes no `pace`",
    ),
    "dataclass by name": (
        f"@dataclass(kw_only=True)\nclass It(Primitive):\n    cell: Any\n    arm: str\n    pace: float{TICK}",
        "takes no cell",
    ),
    "no tick": ("class It(Primitive):\n    def __init__(self, cell, *, arm, pace): ...", "has no method `tick`"),
    "asynchronous": ("class It(Good):\n    async def tick(self): ...", "has a method `tick` that is `async`"),
    "tick with a value": ("class It(Good):\n    def tick(self, now): ...", "has a method `tick` that takes `now`"),
    "halt without": ("class It(Good):\n    def halt(self): ...", "has a method `halt` that takes nothing else"),
    "no primitive": ("class It:\n    def __init__(self, cell, *, arm, pace): ...", "is not a primitive"),
    "a function": ("def It(cell, *, arm, pace): ...", "is not a class"),
    "a value": ("It: int = 3", "is not a class"),
    "missing": ("class That(Good): pass", "has no `It`"),
    "no Python": ("class It(Good:", "is not valid Python"),
}
UNTOLD = {
    "decorated": "@unknown\nclass It(Other): pass",
    "decorated constructor": f"class It(Primitive):\n    @unknown\n    def __init__(self, cell, *, arm): {SUPER}{TICK}",
    "made elsewhere": "It = type('It', (Other,), {})",
    "partial": "It = functools.partial(Good, arm='')",
    "what an import raises": "It = Good\nraise RuntimeError('no bus')",
    "bases at run time": "Base = [Other][0]\nclass It(Base): pass",
}
PARAMETERS = [
    Parameter(name=name, direction="in", type=PlainType("Text"), source=Position("it.skill", 1, 1))
    for name in ("arm", "pace")
]
SKILL = """use rparts
skill Fold {
    in arm:  ArmDevice
    in pace: Number
    noplan
}
impl plain of Fold { run python "NAME" }
"""


def told(folder: Path, skills: str) -> list[str]:
    (folder / "it.skill").write_text(skills)
    arguments = ["check", str(folder / "it.skill"), "--json", "--no-cache"]
    result = CliRunner().invoke(skillc, arguments)
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return [each["message"] for each in json.loads(result.stdout)]


@pytest.fixture
def module(request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """A module of its own for each test: Python keeps what it has imported."""
    monkeypatch.syspath_prepend(str(tmp_path))
    return "contract_" + "".join(each if each.isalnum() else "_" for each in request.node.name)


@pytest.mark.parametrize("way", ["itself", "from", "star"])
@pytest.mark.parametrize("text", FITTING.values(), ids=FITTING)
def test_what_fits_is_not_reported(text: str, way: str, module: str, tmp_path: Path) -> None:
    name = written(tmp_path, module, text, way)
    assert told(tmp_path, SKILL.replace("NAME", name)) == []
    assert import_matching_primitive(name, PARAMETERS)


@pytest.mark.parametrize("way", ["itself", "from", "star"])
@pytest.mark.parametrize(("text", "words"), TOLD.values(), ids=TOLD)
def test_what_does_not_fit_is_reported_and_refused(
    text: str, words: str, way: str, module: str, tmp_path: Path
) -> None:
    name = written(tmp_path, module, text, way)
    messages = told(tmp_path, SKILL.replace("NAME", name))
    if way == "itself" or words not in ("has no `It`", "is not valid Python"):
        assert any(words in message for message in messages), messages
    with pytest.raises(PrimitiveError):
        import_matching_primitive(name, PARAMETERS)


@pytest.mark.parametrize("text", UNTOLD.values(), ids=UNTOLD)
def test_what_the_text_does_not_tell_is_refused_when_it_is_prepared(text: str, module: str, tmp_path: Path) -> None:
    name = written(tmp_path, module, text, "itself")
    assert told(tmp_path, SKILL.replace("NAME", name)) == []
    with pytest.raises(PrimitiveError, match=f"{module}:It"):
        import_matching_primitive(name, PARAMETERS)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("def it(world, a, b): ...", None),
        ("def it(world, first, second=1, *more): ...", None),
        ("def it(*values): ...", None),
        ("it = lambda world, a, b: a", None),
        ("def it(world, b, a): ...", "takes `b`, `a` after the world, in this order"),
        ("def it(world, a): ...", "takes `a` after the world, 1 in number"),
        ("def it(world, a, b, c): ...", "3 in number"),
        ("def it(world, a, b, *, c): ...", "takes `c` by name only"),
        ("def it(): ...", "takes no world"),
        ("async def it(world, a, b): ...", "is `async`"),
        ("it = 3", "is not a function"),
    ],
)
def test_functions_take_the_world_and_their_values_in_order(
    text: str, words: str | None, module: str, tmp_path: Path
) -> None:
    (tmp_path / f"{module}.py").write_text(text + "\n")
    messages = told(tmp_path, f'function it(a: Number, b: Number) -> Number = python "{module}:it"\n')
    assert [words in message for message in messages] == ([] if words is None else [True]), messages
    in_order = words is None or "in this order" in words
    assert (check_function(f"{module}:it", 2) is None) == in_order


@pytest.mark.sim
def test_a_function_that_cannot_be_called_refuses_a_task_before_anything_moves(
    module: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / f"{module}.py").write_text("def made():\n    return lambda world: 1.0\nit = made()\n")
    tmp_path = tmp_path / "late"
    tmp_path.mkdir()
    (tmp_path / "scene.ttl").write_text("@prefix : <https://w3id.org/skillc/library/late#> .\n:C a :Cup .\n")
    (tmp_path / "late.skill").write_text(
        f'class Cup < Thing\nfunction it(a: Number) -> Number = python "{module}:it"\n'
        'task late {\n    scene "scene.ttl"\n    do seq {\n        wait 1 s\n        check(it(2) == 1)\n    }\n}\n'
    )
    monkeypatch.chdir(tmp_path)
    ran = CliRunner().invoke(skillc, ["run", ":late"])
    said = " ".join(ran.output.split())
    assert ran.exit_code == 3 and "cannot be called with 1 values: too many positional arguments" in said


def written(folder: Path, module: str, text: str, way: str) -> str:
    """Write a module with `It`, and one that hands it on; return the name under which a skill finds it."""
    (folder / f"{module}.py").write_text(f"{HEAD}{text}\n")
    package = folder / f"{module}_pack"
    package.mkdir()
    (package / "__init__.py").write_text("from .inner import It\n" if way == "from" else "from .inner import *\n")
    (package / "inner.py").write_text(f"from {module} import *\n")
    return f"{module}:It" if way == "itself" else f"{module}_pack:It"
