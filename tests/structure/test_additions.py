"""A decorator is added in four files and its test, a flag in three and its test: all else is made of the rows."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path

import msgspec
import pytest

from skillc_dsl.descriptions.members import FLAGS
from skillc_dsl.descriptions.nodes import DECORATORS
from skillc_dsl.descriptions.rows import Decorator, Flag
from skillc_dsl.formatting.formatter import format_source
from skillc_dsl.source import Source
from skillc_model import tree
from skillc_model.skills import Skill
from skillc_runtime.execution.tree.nodes.decorators import DECORATORS as TICKS
from structure.additions import DECORATOR, FLAG
from waiting import LONG_S

LIBRARY = """\
## Stay.
skill Stay {
    noplan
    gentle
}

impl put of Stay {
    do seq {
        linger 2 s { wait 1 s }
        linger 1 s { wait 1 s }
    }
}

test stays {
    scene "lab.ttl"
    do    Stay()
}
"""
SCENE = """\
@prefix rparts: <http://www.inf.ufrgs.br/phi-group/ontologies/RParts.owl#> .
@prefix lab: <http://example.org/lab#> .
lab:Arm-1 a rparts:ArmDevice .
"""


@pytest.mark.parametrize("row", DECORATORS, ids=lambda row: row.kind)
def test_each_decorator_has_its_struct_and_its_tick(row: Decorator) -> None:
    kind = next(each for each in TICKS if tree.kind_of(each) == row.kind)
    fields = [each.name for each in msgspec.structs.fields(kind)]
    assert fields == [*(slot.field for slot in row.slots), "child", "source"]
    assert tree.DECORATORS[row.kind] is kind
    assert len(TICKS) == len(tree.DECORATORS) == len(DECORATORS)


@pytest.mark.parametrize("row", DECORATORS, ids=lambda row: row.kind)
def test_each_form_is_one(row: Decorator) -> None:
    text = f"impl put of Stay {{\n    do {row.written.replace('..', 'wait 1 s')}\n}}\n"
    assert format_source(Source("own.skill", text)).value == text


@pytest.mark.parametrize("row", FLAGS, ids=lambda row: row.keyword)
def test_each_flag_has_its_field(row: Flag) -> None:
    fields = {each.name: each.default for each in msgspec.structs.fields(Skill)}
    assert fields[row.field] is not row.value


def test_so_many_files_are_edited() -> None:
    assert (len(DECORATOR), len(FLAG)) == (4, 2)


@pytest.mark.slow
def test_a_decorator_and_a_flag_more(tmp_path: Path) -> None:
    (tmp_path / "stay.skill").write_text(LIBRARY, "utf-8")
    (tmp_path / "lab.ttl").write_text(SCENE, "utf-8")
    script = str(Path(__file__).with_name("additions.py"))
    done = subprocess.run([sys.executable, script, str(tmp_path)], cwd=tmp_path, capture_output=True, timeout=LONG_S)
    assert done.returncode == 0, done.stderr.decode()
    told = json.loads(done.stdout)
    assert {name: each["code"] for name, each in told["commands"].items()} == dict.fromkeys(told["commands"], 0), told
    assert told["colours"]["linger"] == told["colours"]["gentle"] == "Token.Keyword"
    assert "… linger" in told["commands"]["graph"]["out"]
    written = "\n".join(path.read_text("utf-8") for path in (tmp_path / "build/trees").iterdir())
    assert re.search(r'<Linger msec="2000">\s*<Sleep msec="1000" />', written)
    assert "Stays running for a time after its child has succeeded." in written
    library = json.loads((tmp_path / "build/library.json").read_text("utf-8"))
    assert library["skills"]["Stay"]["gentle"] is True
    assert "Does not hurt." in (tmp_path / "build/docs/Stay.md").read_text("utf-8")
    assert "5.0 s" in told["commands"]["test"]["out"], told["commands"]["test"]
