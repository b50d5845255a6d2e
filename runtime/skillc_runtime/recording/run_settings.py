"""How a task is run, as it is recorded."""

from __future__ import annotations

import msgspec


class RunSettings(msgspec.Struct, frozen=True, omit_defaults=True):
    """How a task is run.

    `approve`: each plan waits for approval. `deadline_s`: the task fails if it has not ended so long after its
    submission, in s of the cell. `step_deadline_s`: a primitive or a wait fails if it has not ended so long after its
    start, without the time that it was paused. `ask_after_failure`: a failed step waits for a decision instead of
    another plan. A higher `priority` comes first of the tasks that wait for devices or planners.
    """

    approve: bool = False
    deadline_s: float | None = None
    ask_after_failure: bool = False
    priority: int = 0
    step_deadline_s: float | None = None
