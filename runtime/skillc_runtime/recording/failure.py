"""Why a node failed, and why an implementation was rejected."""

from __future__ import annotations

from typing import Literal, TypeAlias

import msgspec

from skillc_dsl.position import Position
from skillc_runtime.world.state.labels.labelled import LabelledValue

FailureKind: TypeAlias = Literal[
    "pre",
    "hold",
    "verify",
    "always",
    "post",
    "inference",
    "lock",
    "timeout",
    "body",
    "space",
    "plan",
    "contradiction",
    "error",
    "halted",
    "interrupted",
]
Stage: TypeAlias = Literal["argument", "inference", "pre", "hold", "lock", "start", "run"]

_KIND_OF_STAGE: dict[Stage, FailureKind] = {
    "argument": "pre",
    "inference": "inference",
    "pre": "pre",
    "hold": "hold",
    "lock": "lock",
    "start": "body",
    "run": "body",
}


class Failure(msgspec.Struct, frozen=True, kw_only=True):
    """Why a node failed; `source` is the responsible line, `skill` the innermost skill.

    `message` is the cause in one sentence, `detail` what there is to say besides. `values` are the values in a
    primitive's message, by name. `causes` are the failures that this one combines, those of all alternatives that were
    tried: first the one whose message it has. `alternative` names one of several, for example `Pick[across]`.
    """

    kind: FailureKind
    message: str
    detail: str = ""
    source: Position | None = None
    skill: str = ""
    alternative: str = ""
    values: dict[str, LabelledValue] = {}
    causes: tuple[Failure, ...] = ()

    @property
    def breaks_hold(self) -> bool:
        """Whether a hold or `verify` line was violated, here or in a cause; such a failure never becomes a success."""
        return self.kind in ("hold", "verify") or any(cause.breaks_hold for cause in self.causes)

    @property
    def lacks_space(self) -> bool:
        """Whether only reach, a range of a joint, a way or room was missing, in all alternatives that were tried."""
        return self.kind == "space" or (bool(self.causes) and all(cause.lacks_space for cause in self.causes))

    @property
    def is_unmet_need(self) -> bool:
        """Whether an argument or a precondition kept something from being tried; nothing was measured then."""
        return self.kind in ("pre", "inference")


class Rejection(msgspec.Struct, frozen=True, kw_only=True):
    """An implementation that was rejected, at which stage, and why.

    `failure` is its failure if the implementation had started, now or in an earlier attempt.
    """

    implementation: str
    stage: Stage
    reason: str
    source: Position
    failure: Failure | None = None


def as_failure(rejected: Rejection, skill: str) -> Failure:
    """Return a rejection as the failure of a call that has no other implementation."""
    if rejected.failure is not None:
        return rejected.failure
    kind = _KIND_OF_STAGE[rejected.stage]
    return Failure(kind=kind, message=rejected.reason, source=rejected.source, skill=skill)
