"""An analysis that reuses the one before finds what an analysis from nothing finds; `SEQUENCES=5000` tries so many.

Run as a program with a seed, it prints what an analysis from nothing finds at the end of that sequence.
"""

from __future__ import annotations

import os
import subprocess
import sys
from functools import cache

import pytest
from edit_sequences import STEPS, edited_libraries

from skillc_compiler.ide.analysis import analyse
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Outcome
from skillc_dsl.parsing.parser import parse
from skillc_dsl.query import Memo
from skillc_dsl.rendering import json
from skillc_dsl.source import Source

SEQUENCES = int(os.environ.get("SEQUENCES", "2"))


@cache
def parsed(source: Source) -> Outcome[s.File]:
    """Parse a source once."""
    return parse(source)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(SEQUENCES))
def test_an_incremental_analysis_equals_a_cold_one(seed: int) -> None:
    memo = Memo()
    for step, library in enumerate(edited_libraries(seed)):
        again, cold = analyse(library, parsed, memo).compiled, analyse(library).compiled
        assert again.diagnostics == cold.diagnostics, f"seed {seed}, step {step}"
        assert again.value == cold.value, f"seed {seed}, step {step}"
    assert step == STEPS


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
def test_the_edits_of_a_sequence_change_what_is_found(seed: int) -> None:
    found = {analyse(library).compiled.diagnostics for library in edited_libraries(seed)}
    assert len(found) > 1


@pytest.mark.parametrize("seed", range(max(1, SEQUENCES // 25)))
def test_an_incremental_analysis_equals_that_of_a_fresh_process(seed: int) -> None:
    memo = Memo()
    for library in edited_libraries(seed):
        again = analyse(library, parsed, memo).compiled
    fresh = subprocess.run([sys.executable, __file__, str(seed)], capture_output=True, encoding="utf-8", check=True)
    assert fresh.stdout == json.render(again.diagnostics, {})


if __name__ == "__main__":
    *_, last = edited_libraries(int(sys.argv[1]))
    sys.stdout.write(json.render(analyse(last).compiled.diagnostics, {}))
