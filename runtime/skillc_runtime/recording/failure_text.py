"""Failures as text: one sentence for everybody, and all details for those who want to know more."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from skillc_runtime.recording.failure import Failure

MAX_LISTED: Final = 3
"""How many of the other ways a sentence lists."""


def describe_failure(failure: Failure) -> str:
    """Return the cause of a failure, then the other ways that were tried, then whether another plan was found.

    Nothing is said twice. What was never tried, since an argument or a precondition did not fit, is a detail.
    """
    causes = list(_innermost(failure))
    tried = {each.message: each for each in causes if not each.is_unmet_need and each.kind != "plan"}
    tried.pop(failure.message, None)
    ways = [_name_way(each) for each in tried.values()]
    more = len(ways) - MAX_LISTED
    listed = "; ".join([*ways[:MAX_LISTED], *([f"and {more} more"] if more > 0 else [])])
    parts = [failure.message, *([f"other ways were tried: {listed}"] if ways else [])]
    return "; ".join(dict.fromkeys([*parts, *(each.message for each in causes if each.kind == "plan")]))


def list_details(failure: Failure) -> Iterator[str]:
    """Yield the detail of a failure, and below it each cause that it combines, one a line, indented by its depth."""
    if failure.detail:
        yield failure.detail
    for cause in failure.causes:
        where = f" ({cause.source})" if cause.source is not None else ""
        yield f"{_name_way(cause)}{where}"
        yield from (f"  {line}" for line in list_details(cause))


def _innermost(failure: Failure) -> Iterator[Failure]:
    """Yield the failures that combine no others, in the order of their importance."""
    if not failure.causes:
        yield failure
    for cause in failure.causes:
        yield from _innermost(cause)


def _name_way(failure: Failure) -> str:
    return f"{failure.alternative}: {failure.message}" if failure.alternative else failure.message
