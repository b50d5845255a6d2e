"""The outcomes of cases, and their table: a row for each kind of trouble."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable
from typing import Literal, TypeAlias, get_args

from random_cells.happening import DEEDS
from random_cells.spoiling import FAULTS, Case, Trouble, draw_case
from skillc_runtime.evaluation.trials.trial import Trial

Outcome: TypeAlias = Literal[
    "success, verified", "finished, not verified", "honest failure", "refused before moving", "FALSE SUCCESS", "crash"
]

BAD: tuple[Outcome, ...] = ("FALSE SUCCESS", "crash")
"""The outcomes that no case may have."""

UNSPEAKABLE = ("Traceback", "KeyError", "Error:", "Invalid name")
"""What no sentence for a user contains."""


def classify(trial: Trial) -> Outcome:
    """Return the outcome of a trial; a failure without a sentence, or with something still moving, is a crash."""
    if trial.status == "refused":
        return "refused before moving" if _is_sentence(trial.reason) else "crash"
    if trial.is_false_success:
        return "FALSE SUCCESS"
    if trial.status == "succeeded":
        return "finished, not verified" if trial.verified is False else "success, verified"
    return "honest failure" if trial.status == "failed" and _is_sentence(trial.reason) and trial.at_rest else "crash"


def format_table(trials: Iterable[Trial], draw: Callable[[int, int], Case] = draw_case) -> str:
    """Return the table, and the share of the solvable cases that succeeded, if there were any."""
    found = Counter((draw(each.seed, 1).trouble, classify(each)) for each in trials)
    outcomes: tuple[Outcome, ...] = get_args(Outcome)
    troubles = [each for each in ("none", *FAULTS, *DEEDS) if any(found[each, outcome] for outcome in outcomes)]
    head = f"{'trouble':14}" + "".join(f"{each:>24}" for each in outcomes)
    rows = [f"{each:14}" + "".join(f"{found[each, outcome]:24}" for outcome in outcomes) for each in troubles]
    return "\n".join((head, *rows, *((_format_share(found),) if "none" in troubles else ())))


def _format_share(found: Counter[tuple[Trouble, Outcome]]) -> str:
    solvable = sum(count for (trouble, _), count in found.items() if trouble == "none")
    solved = found["none", "success, verified"] + found["none", "finished, not verified"]
    return f"{solved} of {solvable} solvable cells succeeded"


def _is_sentence(reason: str | None) -> bool:
    return bool(reason) and not any(each in str(reason) for each in UNSPEAKABLE)
