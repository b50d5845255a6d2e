"""What is kept of one run among many."""

from __future__ import annotations

from typing import Literal, TypeAlias

import msgspec

from skillc_runtime.evaluation.measures.work import Work

Status: TypeAlias = Literal["success", "failure", "halted", "refused", "crashed"]
"""How a task ended; `crashed` where the process that ran it did not live to say so."""

Disturbance: TypeAlias = Literal["none", "missing", "obstacle", "push"]
"""What happens besides: what is worked on is not there, something is in the way, a person pushes the arm."""


class Trial(msgspec.Struct, frozen=True, kw_only=True):
    """One run: its seed, how it ended and why, how reality differed from the world model, and what was measured.

    `assumed` are the facts that a success rests on and nothing sensed; it is `verified` when there are none.
    `works` has an entry for each thing that was worked on; `coverage` is of all the run did, lowest of all surfaces
    wiped or not.
    `greatest_force_n` is the most that any tool felt, `force_limit_n` the least of what makes an arm hold
    still, None where no arm has such a limit.
    `pushed` tells whether a person pushed the arm, `at_rest` whether everything stood still, and nothing pushed any
    more, in the end.
    """

    seed: int
    status: Status
    reason: str | None = None
    verified: bool | None = None
    assumed: tuple[str, ...] = ()
    variation: str = ""
    works: tuple[Work, ...] = ()
    coverage: float = 0.0
    greatest_force_n: float = 0.0
    force_limit_n: float | None = None
    pushed: bool = False
    at_rest: bool = False
    sim_time_s: float = 0.0
    wall_time_s: float = 0.0
