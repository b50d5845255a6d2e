"""Why there is no plan, at the command line: the answer names the nearest thing that a person can change."""

from __future__ import annotations

import re
from pathlib import Path
from typing import NamedTuple

import pytest
from click.testing import CliRunner

from skillc.cli.main import skillc

FOLDER = Path(__file__).parent / "why"
CLEAN = "lab:Board-1.isClean == true"
PUT = "lab:Part-1 lies lab:Slot-1"
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
        "`lab:Brick lies lab:Slot-1` holds, and Put does not start while it does",
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


def plan(folder: Path, kind: Kind) -> tuple[int, str]:
    """Plan in the cell with one thing spoilt."""
    found = 0
    for file, name in (("mopping.skill", "why.skill"), ("cell.ttl", "cell.ttl")):
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


@pytest.mark.slow
@pytest.mark.parametrize("goal", [CLEAN, PUT])
def test_the_cell_has_plans(goal: str, why: Path) -> None:
    assert plan(why, Kind(goal, "lib:charge 80", "lib:charge 80", ""))[0] == 0


@pytest.mark.slow
@pytest.mark.parametrize("name", KINDS)
def test_the_answer_names_what_a_person_can_change(name: str, why: Path) -> None:
    kind = KINDS[name]
    code, said = plan(why, kind)
    first = said.splitlines()[0]
    assert code == 3 and kind.says in first, said
    assert not re.search(f"{NEVER}|{kind.never}", first), said
