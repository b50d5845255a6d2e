"""The states of a task run."""

from __future__ import annotations

from typing import Literal, TypeAlias, get_args

EndState: TypeAlias = Literal["succeeded", "failed", "stopped", "interrupted"]
"""The states in which a task run ends; `interrupted` if its process or its machine died."""
ENDS: frozenset[str] = frozenset(get_args(EndState))

State: TypeAlias = Literal["queued", "planning", "planned", "running", "pausing", "paused", "stopping"] | EndState
"""The states of a task run; `queued` if it waits for devices, `planned` if its plan waits for approval."""

Decision: TypeAlias = Literal["replan", "retry", "skip"]
"""How an interrupted run is continued: by planning again for the world as it is, beginning with the step that was
running, or counting that step as done."""
