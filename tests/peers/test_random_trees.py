"""Random trees run in BehaviorTree.CPP 4.8.2 as they are meant to; `make peers` does the same in other versions.

20 trees by default; SKILLC_TREES says how many.
"""

from __future__ import annotations

import os
from pathlib import Path
from random import Random

import pytest

from fuzz.kinds.trees import draw_library
from peers.comparing import differences
from skillc_compiler.emit import bt

TREES = int(os.environ.get("SKILLC_TREES", "20"))
BLOCKS = 2


@pytest.mark.slow
@pytest.mark.parametrize("block", range(BLOCKS))
def test_a_random_tree_runs_as_it_is_meant_to(block: int, tmp_path: Path) -> None:
    number = seed = 0
    while number < TREES // BLOCKS:
        library = draw_library(Random(f"{block} {seed}"), tmp_path)
        for name, text in bt.emit(library).items():
            path = tmp_path / name.replace("/", "_")
            path.write_text(text, "utf-8")
            assert list(differences(path)) == [], f"block {block}, seed {seed}"
            number += 1
        seed += 1
    assert number
