"""Planner, world model and execution do in random worlds what the text of a library says.

30 worlds by default, in libraries of edition 2 with five each; SKILLC_WORLDS says how many.
"""

from __future__ import annotations

import os
from random import Random

import pytest

from columns.case import WORLDS, draw_case
from columns.columns import Counts, check_execution, check_knowledge, check_planner

LIBRARIES = int(os.environ.get("SKILLC_WORLDS", "30")) // WORLDS
BLOCKS = 2


@pytest.mark.slow
@pytest.mark.parametrize("block", range(BLOCKS))
def test_all_do_what_the_text_says(block: int) -> None:
    counts = Counts()
    for seed in range(block, LIBRARIES, BLOCKS):
        for case in draw_case(seed, WORLDS).each_world():
            check_knowledge(case, Random(seed), counts)
            check_execution(case, counts)
            check_planner(case, Random(seed), counts)
    print(*(f"{number} {what}" for what, number in sorted(counts.of.items())), sep=", ")
    assert counts.of["steps"] > 0 and counts.of["bodies that succeed"] > 0 and counts.of["plan, proven"] > 0


def test_the_world_model_holds_what_the_text_says() -> None:
    counts = Counts()
    for case in draw_case(1, 24).each_world():
        check_knowledge(case, Random(1), counts)
    assert counts.of["conditions"] == 4 * 24 and counts.of["steps"] > 100
