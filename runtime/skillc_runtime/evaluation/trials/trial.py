"""The result of one trial."""

from __future__ import annotations

from typing import Literal, TypeAlias

import msgspec

from skillc_runtime.evaluation.measures.work import Work
from skillc_runtime.recording.states import EndState

TRIAL_LIMIT_S = 3600.0
"""How long one trial may take, in s of wall-clock time."""

Status: TypeAlias = EndState | Literal["refused", "crashed"]
"""How a task ended; `refused` if it did not start, `crashed` if its process ended without a result."""

TrialDisturbance: TypeAlias = Literal["none", "missing", "obstacle", "push", "take"]
"""How a trial is disturbed: the work object is missing, an obstacle is in the way, a person pushes the arm, or takes
what a hand holds out of it."""


class Trial(msgspec.Struct, frozen=True, kw_only=True):
    """One run: its seed, how it ended and why, how reality differed from the world model, and what was measured.

    `assumed` are the facts that a success rests on and that were not sensed; it is `verified` if there are none.
    `works` has an entry for each object that was worked on; `coverage` is the lowest of all surfaces, wiped or not,
    over the whole run, None without surfaces. `greatest_force_n` is the greatest contact force on any tool, None
    without tools, `force_limit_n` the lowest limit of the arms, None if no arm has one. `pushed` is whether a person
    pushed the arm, `taken` whether they took what a hand held, `at_rest` whether at the end nothing moved and no force
    was applied. `false_claims` are sentences about what the world model claims at the end of things and where they are,
    and what really is so.
    """

    seed: int
    status: Status
    reason: str | None = None
    verified: bool | None = None
    assumed: tuple[str, ...] = ()
    variation: str = ""
    false_claims: tuple[str, ...] = ()
    works: tuple[Work, ...] = ()
    coverage: float | None = None
    greatest_force_n: float | None = None
    force_limit_n: float | None = None
    pushed: bool = False
    taken: bool = False
    at_rest: bool = False
    sim_time_s: float = 0.0

    @property
    def is_false_success(self) -> bool:
        """Whether the task succeeded, by what the world model claims, and a claim is false."""
        return self.status == "succeeded" and bool(self.false_claims)
