"""The bodies of requests, and answers, that only the API has; clients share them."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

import msgspec

from skillc.server.access.roles import Role
from skillc.server.values import CheckedBody, Name, Why, check_name, check_why
from skillc.workers.devices import Device
from skillc_dsl.rendering.json import DiagnosticData
from skillc_runtime.execution.pace import SLOWEST

MAX_PACE = 1000.0
MAX_REASON = 500
MAX_LEASE_S = 3600.0
MAX_PLANNING_S = 60.0


class ProblemDetails(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """Why a request was refused; nothing has changed. `detail` says what to do.

    `type` is `about:blank`, and `title` the phrase of the status, unless there is more to know than the status.
    `allowed` are the commands that the state of an operation allows. `diagnostics` are the errors of a goal, a call or
    an argument, as of `skillc check --json`, and `texts` what they point into, by path; long texts are left out.
    """

    type: str = "about:blank"
    title: str
    status: int
    detail: str
    allowed: tuple[str, ...] | None = None
    diagnostics: tuple[DiagnosticData, ...] | None = None
    texts: dict[str, str] | None = None


EditText: TypeAlias = Annotated[str, msgspec.Meta(min_length=1, max_length=2000)]


class PaceSetting(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """How fast the cell's time may pass: `factor` times real time; null for as fast as it computes."""

    factor: Annotated[float, msgspec.Meta(ge=SLOWEST, le=MAX_PACE)] | None


class StopReason(msgspec.Struct, frozen=True):
    """Why an operation, or everything, is stopped. A long reason is cut, and what else a body has is ignored."""

    reason: str = "stopped"

    @property
    def shown(self) -> str:
        """The reason as it is recorded."""
        return self.reason if len(self.reason) <= MAX_REASON else f"{self.reason[:MAX_REASON]} .."


class ReportRequest(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What a report has: without a `film` it is made in a fraction of the time."""

    film: bool = True


class VersionInfo(msgspec.Struct, frozen=True):
    """The version of skillc, and that of the API."""

    skillc: str
    api: str


class LibraryStatus(msgspec.Struct, frozen=True):
    """A library, and the cells whose next operations run it.

    `problem` is why that is not the one on disk; empty if it is. `pending` if its files have changed, and were not
    checked yet.
    """

    name: str
    hash: str
    problem: str
    cells: tuple[str, ...]
    pending: bool = False


class DeviceStatus(msgspec.Struct, frozen=True):
    """A device, and the operation that holds it; null if it is free."""

    device: Device
    held_by: str | None


class PlanRequest(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A task of the cell's library with arguments, or a goal as a condition or as PDDL, to plan for.

    `prove` searches until the least work is proved; the search ends after `deadline_s` s.
    """

    task: str | None = None
    goal: str | None = None
    arguments: dict[str, str] = {}
    minimise: Literal["work", "makespan"] = "work"
    prove: bool = False
    deadline_s: Annotated[float, msgspec.Meta(gt=0.0, le=MAX_PLANNING_S)] = 30.0


class WorldQuery(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A SPARQL query, SELECT, ASK or CONSTRUCT; the prefixes of the vocabulary are declared."""

    sparql: Annotated[str, msgspec.Meta(min_length=1, max_length=20_000)]


class WorldEdit(CheckedBody, frozen=True, forbid_unknown_fields=True):
    """Changes that are made together or not at all, and why.

    Each is `SUBJECT PREDICATE VALUE`, `not SUBJECT PREDICATE VALUE` or `not INDIVIDUAL`, as of `skillc scene edit`.
    """

    edits: Annotated[tuple[EditText, ...], msgspec.Meta(min_length=1, max_length=200)]
    why: Why

    def check(self) -> None:
        """Raise ValueError for a blank reason."""
        check_why(self.why)


class WorldPlacement(CheckedBody, frozen=True, forbid_unknown_fields=True):
    """Where a thing is, and why this is said: its position in m and a quaternion (w, x, y, z), in the world.

    It stays with what carries it. `thing` is an IRI or `prefix:name`.
    """

    thing: Annotated[str, msgspec.Meta(min_length=1, max_length=500)]
    pose: tuple[float, float, float, float, float, float, float]
    why: Why

    def check(self) -> None:
        """Raise ValueError for a blank reason."""
        check_why(self.why)


class LeaseRequest(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """For how long a client wants to command a cell alone, in s; `takeover` ends the lease of another client."""

    duration_s: Annotated[float, msgspec.Meta(gt=0.0, le=MAX_LEASE_S)] = 60.0
    takeover: bool = False


class LoginCode(msgspec.Struct, frozen=True):
    """A code that a request may have in the place of a token, once, within 60 s."""

    code: str


class SessionInfo(msgspec.Struct, frozen=True):
    """Who makes a request: the name of its token, and what it may do."""

    name: str
    role: Role


class NewToken(CheckedBody, frozen=True, forbid_unknown_fields=True):
    """A token to be made. What an `agent` asks for waits for the approval of somebody else."""

    name: Name
    role: Role
    agent: bool = False

    def check(self) -> None:
        """Raise ValueError for a name with other characters."""
        check_name(self.name)


class MadeToken(msgspec.Struct, frozen=True):
    """A token that was made; `token` is shown this once."""

    name: str
    role: Role
    token: str
