"""Few things are found that are in the way of a step, among many that could be, with few looks."""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil, log2
from random import Random

import pytest

from skillc_runtime.execution.refinement.scope import find_blocking


@pytest.mark.parametrize("seed", range(30))
def test_no_fewer_than_those_that_are_found_block_and_they_do(seed: int) -> None:
    rng = Random(seed)
    things = [f"thing-{number}" for number in range(rng.choice([1, 2, 7, 40, 200]))]
    together = [frozenset(rng.sample(things, min(len(things), rng.randint(1, 3)))) for _ in range(rng.randint(1, 3))]
    asked = list[frozenset[str]]()

    def blocks(there: Sequence[str]) -> bool:
        asked.append(frozenset(there))
        return any(each <= asked[-1] for each in together)

    found = frozenset(find_blocking(things, blocks))
    assert found in together and not any(each < found for each in together)
    assert len(asked) <= 2 * len(found) * (ceil(log2(len(things))) + 1)
