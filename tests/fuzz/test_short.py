"""A few cases of each kind, from the seed that `make fuzz` starts with."""

from pathlib import Path

import pytest

from fuzz.kinds import kind_names
from fuzz.runner import run_case

CASES = 12


@pytest.mark.parametrize("kind", kind_names())
def test_a_few_cases_find_nothing(kind: str, tmp_path: Path) -> None:
    problems = [run_case(kind, 0, index, tmp_path / str(index)) for index in range(CASES)]
    assert [problem for problem in problems if problem is not None] == []
