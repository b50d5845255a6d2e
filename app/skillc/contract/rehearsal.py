"""Rehearsals: what an operation does in a simulated twin of a cell."""

from __future__ import annotations

from typing import Annotated

import msgspec

from skillc_runtime.recording.documented import documented
from skillc_runtime.recording.run_spec import EXECUTION, PLANNING, TaskRequest


class RehearsalRequest(TaskRequest, frozen=True, kw_only=True, tag_field="kind", tag="rehearsal"):
    """A task of a cell's library with arguments, a goal, or a call of a skill, to try in a simulated twin of the cell.

    `cell` may be left out if there is only one. Nobody can be asked: a question is answered at once, by the first of
    `answers` that is a choice, else by its default; without either the rehearsal ends there. It is filmed with `film`,
    and recorded with `record`.
    """

    cell: str | None = None
    seed: Annotated[
        Annotated[int, msgspec.Meta(ge=0, le=2**31)],
        documented("Determines how the twin differs from what is known.", EXECUTION, metavar="N"),
    ] = 0
    deadline_s: Annotated[
        Annotated[float, msgspec.Meta(gt=0.0, le=3600.0)],
        documented("Let the task fail if it has not ended after these seconds of the twin's time.", EXECUTION),
    ] = 600.0
    geometry: Annotated[
        bool, documented("Look whether the arms can carry out a plan, before anything moves.", PLANNING)
    ] = True
    answers: Annotated[
        tuple[Annotated[str, msgspec.Meta(max_length=300)], ...],
        msgspec.Meta(max_length=100),
        documented("Answer what skills ask with this choice, where it is one.", EXECUTION, metavar="CHOICE"),
    ] = ()
    film: bool = False
    record: bool = False
