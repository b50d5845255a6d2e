"""One mistake anywhere in a library is one error at its place; `EDITS=10000` tries so many, as `make mistakes` does."""

import os
from collections.abc import Iterator

import pytest

from random_mistakes.judging import ORIGINS, Origin, Verdict, judge

MOST: dict[Origin, int] = {"shipped": 60, "other": 60, "twelve": 40}
TRIED = {origin: int(os.environ.get("EDITS", most)) for origin, most in MOST.items()}


def verdicts(origin: Origin, count: int) -> Iterator[Verdict]:
    """Yield what is reported for the mistakes of each seed, if they are some."""
    for seed in range(TRIED[origin]):
        verdict = judge(origin, seed, count)
        if verdict is not None:
            yield verdict


@pytest.mark.slow
@pytest.mark.parametrize("origin", ORIGINS)
@pytest.mark.parametrize(("count", "most_wrong"), [(1, 0.04), (2, 0.08)])
def test_there_are_as_many_errors_as_mistakes_and_they_are_there(origin: Origin, count: int, most_wrong: float) -> None:
    seen = list(verdicts(origin, count))
    wrong = [each.words for each in seen if not each.is_exact]
    assert [each.crash for each in seen if each.crash] == []
    assert len(seen) > TRIED[origin] / 3
    assert len(wrong) <= most_wrong * len(seen), "\n".join(wrong)
    far = [each.words for each in seen if not each.is_near]
    assert len(far) <= 0.08 * len(seen), "\n".join(far)
