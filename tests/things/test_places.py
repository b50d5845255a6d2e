"""Where no plan puts a thing into a full or blocked place, the answer names the place and what stands there."""

from __future__ import annotations

from pathlib import Path

import pytest

from skillc_skills import sorting
from things.test_stacks import STACK, plan, steps

SORTING = Path(sorting.__path__[0])
BOX = 'skiros:SizeX 0.16 ; skiros:SizeY 0.16 ; skiros:SizeZ 0.06 ; skillc:colour "0.88 0.66 0.62"'
POST = """
lab:Cell skiros:contain lab:Post .
lab:Post a skillc:Furniture ; skiros:SizeX 0.04 ; skiros:SizeY 0.04 ; skiros:SizeZ 0.15 ;
    skiros:FrameId "post" ; skiros:BaseFrameId "map" ;
    skiros:PositionX 0.45 ; skiros:PositionY 0.15 ; skiros:PositionZ 0.76 .
"""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("more", "goal", "why"),
    [
        (
            "",
            "lab:Box-A contain lab:Part-A and lab:Box-A contain lab:Part-B",
            "lab:Box-A is full: no place of 40 x 40 mm is free beside lab:Part-B",
        ),
        (POST, "lab:Box-A contain lab:Part-A", "no place of 40 x 40 mm on lab:Box-A is clear of lab:Post"),
    ],
)
def test_a_full_or_blocked_place_is_named_with_what_stands_there(
    more: str, goal: str, why: str, tmp_path: Path
) -> None:
    text = (SORTING / "panda.ttl").read_text("utf-8")
    assert BOX in text
    scene = tmp_path / "cell.ttl"
    scene.write_text(text.replace(BOX, "skiros:SizeX 0.11 ; skiros:SizeY 0.11 ; skiros:SizeZ 0.06") + more, "utf-8")
    answer = plan(goal, SORTING, scene)
    assert answer["status"] != "solved"
    assert why in answer["failure"]


@pytest.mark.slow
def test_what_stands_where_another_thing_shall_rest_is_put_elsewhere_in_the_same_place(tmp_path: Path) -> None:
    scene, text = tmp_path / "cell.ttl", (STACK / "cell.ttl").read_text("utf-8")
    assert "skillc:on lab:Block-A ." in text
    scene.write_text(text.replace("skillc:on lab:Block-A .", "skillc:on lab:Block-B ."), "utf-8")
    answer = plan("lab:Block-A restsOn lab:Block-B", STACK, scene)
    assert steps(answer) == ["Pick Block-C", "Place Block-C Cell", "Pick Block-A", "PlaceOn Block-A Block-B"]
    why = " ".join(each["why"] for each in answer["left_out"] if each["kind"] == "steps")
    assert "lab:Block-B is full: no place of 40 x 40 mm is free beside lab:Block-C" in why
