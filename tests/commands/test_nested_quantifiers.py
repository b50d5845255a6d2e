"""Conditions with nested quantifiers do not hold up `plan` and `check`, in whatever order they are written."""

import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from skillc.cli.main import skillc

LINKS = ("option offers a", "a leads b", "b leads c", "c leads d", "d leads e", "e.worth >= 3")
LIBRARY = """use skiros, sumo
class    Unit < Agent
class    Option < Location
class    Record < Location
relation leads(Record, Record)
relation offers(Option, Record)
relation chosen(Unit, Option)  functional
property worth(Record): Number
skill Choose {{
    in   device: Unit
    in   option: Option
    pre  enough: {condition}
    post p1: device chosen option
    duration 1 s
}}
impl by_list of Choose {{ do seq {{ apply p1 }} }}
prefix lab: <http://example.org/lab#>
task choose {{
    scene "cell.ttl"
    goal  lab:Pump chosen lab:Old
}}
"""
SCENE = """@prefix lab: <http://example.org/lab#> .
@prefix own: <https://w3id.org/skillc/library/choice#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
lab:Scene-1 a skiros:Scene .
lab:Pump a own:Unit .
lab:Old a own:Option ; own:offers lab:R0 .
lab:New a own:Option .
"""
COUNT = 75


def _nested() -> str:
    parts, condition = LINKS[:-1], LINKS[-1]
    for variable, part in zip("edcba", reversed(parts), strict=True):
        condition = f"exists {variable}: Record ({part} and {condition})"
    return condition


def _flat() -> str:
    quantifiers = " ".join(f"exists {variable}: Record (" for variable in "abcde")
    return f"{quantifiers}{' and '.join(reversed(LINKS))}{')' * 5}"


def _all_different() -> str:
    """Return a condition that no order of evaluation decides soon: records that differ, and none is worth enough."""
    names = "abcdefgh"
    apart = " and ".join(f"not {one} == {two}" for one in names for two in names if one < two)
    quantifiers = " ".join(f"exists {variable}: Record (" for variable in names)
    return f"{quantifiers}{apart} and h.worth + a.worth >= 1000{')' * len(names)}"


def _write(folder: Path, condition: str) -> Path:
    library = folder / "choice"
    library.mkdir()
    first, _, rest = LIBRARY.format(condition=condition).partition("class ")
    prefix = "prefix lab: <http://example.org/lab#>\n"
    (library / "choice.skill").write_text(f"{first}{prefix}class {rest.replace(prefix, '')}", "utf-8")
    records = (
        f"lab:R{n} a own:Record ; own:worth {n}{f' ; own:leads lab:R{n + 1}' if n + 1 < COUNT else ''} ."
        for n in range(COUNT)
    )
    (library / "cell.ttl").write_text("\n".join((SCENE, *records, "")), "utf-8")
    return library


def _run(library: Path, *arguments: str) -> Result:
    return CliRunner().invoke(skillc, [*arguments, str(library)])


@pytest.mark.slow
@pytest.mark.parametrize("condition", [_nested(), _flat()], ids=["nested", "flat"])
def test_a_chain_of_five_is_found(condition: str, tmp_path: Path) -> None:
    library = _write(tmp_path, condition)
    checked = _run(library, "check", "--no-cache")
    assert checked.exit_code == 0 and "no problems" in checked.output, checked.output
    planned = CliRunner().invoke(skillc, ["plan", f"{library}:choose", "--no-plan-cache", "--json"])
    assert [step["skill"] for step in json.loads(planned.stdout)["plan"]] == ["Choose"]


@pytest.mark.slow
def test_a_condition_that_cannot_be_decided_in_time_ends_planning_at_its_deadline(tmp_path: Path) -> None:
    library = _write(tmp_path, _all_different())
    planned = CliRunner().invoke(skillc, ["plan", f"{library}:choose", "--no-plan-cache", "--deadline", "2.5"])
    assert planned.exit_code == 3 and "it ran out of time" in planned.output, planned.output
    assert "planning, for at most 2.5 s" in planned.output
