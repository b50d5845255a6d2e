"""Why there is no plan, at the command line: the answer names the nearest thing that a person can change."""

from __future__ import annotations

import re
from pathlib import Path
from typing import NamedTuple

import pytest
from click.testing import CliRunner

from plans.depot import goal, library, world
from skillc.cli.main import skillc
from skillc_runtime.planning.plan import Unsolvable
from skillc_runtime.planning.search.astar import AStar
from skillc_runtime.planning.solve import solve

FOLDER = Path(__file__).parent / "why"
CLEAN = "lab:Board-1.isClean == true"
PUT = "lab:Part-1 lies lab:Slot-1"
FAR = "lab:Crate-1 stored lab:T5"
ISLE = "lab:Crate-1 stored lab:Isle"
TICKETS = """lab:Ticket-1 a lib:Ticket ; lib:pays lab:Truck-1 ; lib:isSpent false .
lab:Ticket-2 a lib:Ticket ; lib:pays lab:Truck-1 ; lib:isSpent false .
"""
NEVER = r"not not|all of them together|in the scene fulfils that together|Traceback"


class Kind(NamedTuple):
    """What is written instead of something, what the first line of the answer says, and what it must not say."""

    goal: str
    before: str
    after: str
    says: str
    never: str = "not used"


KINDS = {
    "no implementation": Kind(
        CLEAN,
        'impl softly of Mopping {\n    refine arm: SoftArm\n    run python "nobody:Needs"\n}',
        "",
        "Mopping, which changes it, is left out of planning: it has no implementation",
    ),
    "not planned with": Kind(
        CLEAN, "duration 40 s", "duration 40 s\n    noplan", "is left out of planning: it is `noplan`"
    ),
    "no implementation of what opens the door": Kind(
        CLEAN, "lib:isShut false", "lib:isShut true", "lab:Door-1.isShut", "Slot|charge"
    ),
    "hardware without the flag": Kind(
        CLEAN,
        "lab:Arm-1 a lib:SoftArm",
        "lab:Arm-1 a lib:Arm",
        "lab:Arm-1 is a why:Arm, and Mopping needs a why:SoftArm",
    ),
    "no hand": Kind(CLEAN, " ; lib:endsIn lab:Hand-1", "", "state `lab:Arm-1 why:endsIn lab:Hand-1`"),
    "no arm": Kind(CLEAN, " ; lib:carriesArm lab:Arm-1", "", "state `lab:Cart-1 why:carriesArm lab:Arm-1`"),
    "no force": Kind(
        CLEAN, " ; lib:force 8", "", "lab:Board-1 has no why:force: state `lab:Board-1 why:force NUMBER-IN-N`", "Dock"
    ),
    "no mass": Kind(PUT, "lib:mass 0.2 ; ", "", "lab:Part-1 has no why:mass: state `lab:Part-1 why:mass NUMBER-IN-kg`"),
    "no width": Kind(
        PUT, " ; lib:width 0.05", "", "lab:Part-1 has no why:width: state `lab:Part-1 why:width NUMBER-IN-m`"
    ),
    "no opening": Kind(
        PUT, " ; lib:opening 0.1", "", "lab:Hand-1 has no why:opening: state `lab:Hand-1 why:opening NUMBER-IN-m`"
    ),
    "too heavy": Kind(PUT, "lib:mass 0.2", "lib:mass 20", "lab:Part-1.mass is 20 kg; needed: < 5 kg"),
    "too wide": Kind(
        PUT,
        "lib:width 0.05",
        "lib:width 0.3",
        "lab:Part-1.width is 0.3 m; needed: < 0.1 m, which is lab:Hand-1.opening",
    ),
    "empty battery": Kind(CLEAN, "lib:charge 80", "lib:charge 5", "lab:Cart-1.charge is 5; needed: > 10", "Door"),
    "arm in fault": Kind(CLEAN, "lib:inFault false", "lib:inFault true", "lab:Arm-1.inFault is true"),
    "tilted board": Kind(
        CLEAN, "lib:tilt 0", "lib:tilt 0.7", "lab:Board-1.tilt is 40.107 deg; needed: < 5 deg", "full|force|rad"
    ),
    "place that is taken for good": Kind(
        PUT,
        "lab:Board-1 a",
        "lab:Brick a lib:Part ; lib:mass 50 ; lib:width 0.05 ; lib:lies lab:Slot-1 .\nlab:Board-1 a",
        "lab:Brick.mass is 50 kg; needed: < 5 kg",
        "force",
    ),
    "hand that is full": Kind(
        PUT,
        "lab:Board-1 a",
        "lab:Glue a lib:Part ; lib:mass 50 ; lib:width 0.05 ; lib:lies lab:Hand-1 .\n"
        "lab:Slot-2 a lib:Slot . lab:Board-1 a",
        "`lab:Glue lies lab:Hand-1` holds, and Take does not start while it does",
    ),
    "tool missing": Kind(CLEAN, "lab:Mop-1 a lib:Mop", "lab:Mop-1 a lib:Part", "there is no why:Mop, which Mopping"),
    "tool nowhere": Kind(CLEAN, " ; lib:lies lab:Shelf-1", "", "needs `lab:Mop-1 lies a sumo:Object`"),
    "shelf nowhere": Kind(
        CLEAN,
        "lab:Shelf-1 a lib:Slot ; lib:within lab:Store",
        "lab:Shelf-1 a lib:Slot",
        "needs `lab:Shelf-1 within a why:Place`",
    ),
    "board nowhere": Kind(CLEAN, "lib:within lab:Hall ; lib:tilt", "lib:tilt", "`lab:Board-1 within a why:Place`"),
    "cart nowhere": Kind(CLEAN, "lib:standsAt lab:Dock ; ", "", "needs `lab:Cart-1 standsAt a why:Place`"),
    "thing of another class": Kind(
        "lab:Board-1 lies lab:Slot-1",
        "lib:charge 80",
        "lib:charge 80",
        "lab:Board-1 is a why:Board, and Put needs a why:Part as `part`",
    ),
    "two arms": Kind(
        "lab:Vase lies lab:Hand-2",
        "lab:Board-1 a",
        "lab:Hand-2 a lib:Hand ; lib:opening 0.1 .\nlab:Vase a lib:Fragile ;"
        " lib:mass 1 ; lib:width 0.04 ; lib:lies lab:Rack-1 .\nlab:Board-1 a",
        "lab:Hand-2",
    ),
    "two parts for one place": Kind(
        f"{PUT} and lab:Mop-1 lies lab:Rack-1 and lab:Part-2 lies lab:Slot-1",
        "lab:Board-1 a",
        "lab:Part-2 a lib:Part ; lib:mass 1 ; lib:width 0.05 ; lib:lies lab:Shelf-1 .\nlab:Board-1 a",
        "`lab:Part-2 lies lab:Slot-1` and `lab:Part-1 lies lab:Slot-1` cannot be reached together: once the first is, "
        "`lab:Part-2 lies lab:Slot-1` holds, and Put does not start while it does",
        "Rack",
    ),
    "two things in one hand": Kind(
        f"{CLEAN} and lab:Mop-1 lies lab:Hand-1 and lab:Part-1 lies lab:Hand-1",
        "lib:charge 80",
        "lib:charge 80",
        "once the first is, `lab:Mop-1 lies lab:Hand-1` holds, and Take does not start while it does",
        "isClean",
    ),
    "relation that nothing makes": Kind(
        "lab:Shelf-1 within lab:Hall",
        "lib:charge 80",
        "lib:charge 80",
        "no skill can change this: lab:Shelf-1 within lab:St",
    ),
    "fact that nothing ends": Kind(
        "not lab:Arm-1 mounts lab:Hand-1", "lib:charge 80", "lib:charge 80", "needed: that it does not hold"
    ),
}

HAULAGE = {
    "road missing": Kind(FAR, ", lab:T5 .", " .", "Drive needs `a why:Town road lab:T5`", "crossing"),
    "crane broken": Kind(
        FAR, "lab:T2 ; lib:works true", "lab:T2 ; lib:works false", "lab:Crane-2.works is false; needed: true"
    ),
    "crane nowhere": Kind(FAR, "lib:serves lab:T5 ; ", "", "state `lab:Crane-5 why:serves lab:T5`"),
    "key nowhere": Kind(FAR, "lib:kept lab:T1 ; ", "", "FetchKey needs `lab:Key-1 kept a why:Town`", "bars"),
    "key of another lock": Kind(
        FAR, " ; lib:opens lab:Gate-1", "", "OpenGate needs `lab:Key-1 opens lab:Gate-1`", "bars"
    ),
    "key behind its gate": Kind(FAR, "lib:kept lab:T1", "lib:kept lab:T5", "lab:Gate-1"),
    "gate that no skill opens": Kind(
        FAR,
        "post  open:  gate.isOpen == true",
        "post  open:  gate.isOpen == true\n    noplan",
        "OpenGate, which changes it, is left out of planning: it is `noplan`",
    ),
    "crate too heavy": Kind(FAR, "lib:mass 500", "lib:mass 5000", "lab:Crate-1.mass is 5000 kg; needed: <= 1000 kg"),
    "crate too high": Kind(
        FAR, "lib:height 2", "lib:height 9", "lab:Crate-1.height is 9 m; needed: <= 4 m, which is lab:Crane-2.reach"
    ),
    "no fuel": Kind(FAR, "lib:isFuelled true", "lib:isFuelled false", "lab:Truck-1.isFuelled is false; needed: true"),
    "fuel unknown": Kind(FAR, " ; lib:isFuelled true", "", "state `lab:Truck-1 why:isFuelled true`"),
    "limit unknown": Kind(FAR, " ; lib:limit 1000", "", "state `lab:Truck-1 why:limit NUMBER-IN-kg`"),
    "truck nowhere": Kind(FAR, "lib:parked lab:T0 ; ", "", "needs `lab:Truck-1 parked a why:Town`"),
    "ticket of another truck": Kind(
        ISLE, TICKETS, TICKETS.replace("lib:pays lab:Truck-1 ; ", ""), "Ferry needs `a why:Ticket pays lab:Truck-1`"
    ),
    "ticket spent": Kind(
        ISLE, TICKETS, TICKETS.replace("false", "true"), "Ferry needs `lab:Ticket-1.isSpent == false`"
    ),
    "no office": Kind(
        "lab:Crate-1.isSealed == true",
        "lib:hasOffice true",
        "lib:hasOffice false",
        "lab:T2.hasOffice is false; needed: true",
    ),
    "one of all too heavy": Kind(
        "forall crate: Crate (crate stored lab:T5)",
        "lib:mass 900",
        "lib:mass 9000",
        "lab:Crate-2.mass is 9000 kg; needed: <= 1000 kg",
        "Crate-1",
    ),
    "either of two": Kind(
        f"{FAR} or lab:Crate-2 stored lab:T5",
        "lab:T5 ; lib:works true",
        "lab:T5 ; lib:works false",
        "lab:Crane-5.works is false; needed: true",
    ),
    "two crates on one truck": Kind(
        "lab:Crate-1 loaded lab:Truck-1 and lab:Crate-2 loaded lab:Truck-1",
        "lib:height 2",
        "lib:height 2",
        "cannot be reached together: once the first is, `lab:Crate-1 loaded lab:Truck-1` holds, and Load does not",
    ),
}


def plan(folder: Path, kind: Kind, cell: tuple[str, str] = ("mopping.skill", "cell.ttl")) -> tuple[int, str]:
    """Plan in a cell with one thing spoilt."""
    found = 0
    for file, name in zip(cell, ("why.skill", "cell.ttl"), strict=True):
        text = (FOLDER / file).read_text("utf-8")
        found += kind.before in text
        (folder / name).write_text(text.replace(kind.before, kind.after, 1), "utf-8")
    assert found == 1, "what is spoilt is there once"
    options = ("--library", str(folder), "--scene", str(folder / "cell.ttl"), "--goal", kind.goal, "--no-plan-cache")
    result = CliRunner().invoke(skillc, ["plan", *options])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result.exit_code, result.stdout


@pytest.fixture(scope="module")
def why(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of the library, which is compiled again only where a kind changes it."""
    folder = tmp_path_factory.mktemp("no_plan") / "why"
    folder.mkdir()
    return folder


@pytest.fixture(scope="module")
def towns(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of the library of trucks."""
    folder = tmp_path_factory.mktemp("no_way") / "why"
    folder.mkdir()
    return folder


@pytest.mark.slow
@pytest.mark.parametrize("goal", [CLEAN, PUT])
def test_the_cell_has_plans(goal: str, why: Path) -> None:
    assert plan(why, Kind(goal, "lib:charge 80", "lib:charge 80", ""))[0] == 0


@pytest.mark.slow
@pytest.mark.parametrize("goal", [FAR, f"{ISLE} and lab:Truck-1 parked lab:T3", "lab:Crate-1.isSealed == true"])
def test_the_towns_have_plans(goal: str, towns: Path) -> None:
    assert plan(towns, Kind(goal, "lib:height 2", "lib:height 2", ""), ("haulage.skill", "towns.ttl"))[0] == 0


@pytest.mark.slow
@pytest.mark.parametrize("name", KINDS)
def test_the_answer_names_what_a_person_can_change(name: str, why: Path) -> None:
    check(KINDS[name], *plan(why, KINDS[name]))


@pytest.mark.slow
@pytest.mark.parametrize("name", HAULAGE)
def test_the_answer_names_what_is_wrong_on_the_way(name: str, towns: Path) -> None:
    check(HAULAGE[name], *plan(towns, HAULAGE[name], ("haulage.skill", "towns.ttl")))


def check(kind: Kind, code: int, said: str) -> None:
    """Check the first line of an answer."""
    first = said.splitlines()[0]
    assert code == 3 and kind.says in first, said
    assert not re.search(f"{NEVER}|{kind.never}", first), said


def test_a_skill_that_gives_another_value_is_not_said_to_be_left_out() -> None:
    state = world({"one": "a"}, {"near": "a"})
    answer = solve(library(), state, goal("lab:near.turned == false", state), (AStar(),))
    assert isinstance(answer, Unsolvable) and "noplan" not in answer.message and "turned" in answer.message
