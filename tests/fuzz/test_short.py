"""A few cases of each kind, from the seed that `make fuzz` starts with."""

from pathlib import Path

import pytest

from fuzz.kinds import kind_names
from fuzz.runner import run_case

CASES = 4
SLOW = {"editor": 1, "planning": 2}
"""How many cases of kinds that take long."""


@pytest.mark.slow
@pytest.mark.parametrize("kind", kind_names())
def test_a_few_cases_find_nothing(kind: str, tmp_path: Path) -> None:
    problems = [run_case(kind, 0, index, tmp_path / str(index)) for index in range(SLOW.get(kind, CASES))]
    assert not any(problems), "\n".join(filter(None, problems))
