"""Why a run did what it did."""

from __future__ import annotations

from typing import Annotated

import msgspec

from skillc_dsl.position import Position
from skillc_runtime.recording.history.origins import ValueOrigin


class ExplainedCall(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """A call, explained as `skillc why RUN NUMBER` does, with those inside it after it.

    `parameters` are those with values; the question `NUMBER.PARAMETER` asks where one comes from.

    `node` is the one in the tree and the events, 0 if the call never started. `source` is the place of the call,
    `implementation_source` that of the implementation that it chose last.
    """

    number: str
    skill: str
    status: str
    lines: tuple[str, ...]
    node: int = 0
    source: Position | None = None
    implementation_source: Position | None = None
    parameters: tuple[str, ...] = ()


class ChainedFailure(msgspec.Struct, frozen=True):
    """A link of the chain that leads from the outermost call that failed to the cause, with its place."""

    name: str
    message: str
    source: Position


class RunExplanation(msgspec.Struct, frozen=True):
    """Why a run, up to its event `sequence`, did what it did: `lines` as `skillc why` prints them, and each call.

    `answer` has the lines for a question, none without. For a question about a parameter, `origins` says where its
    value comes from in each call that has one.
    """

    sequence: int
    lines: tuple[str, ...]
    chain: tuple[ChainedFailure, ...]
    calls: tuple[ExplainedCall, ...]
    answer: tuple[str, ...]
    origins: tuple[ValueOrigin, ...] = ()


class Question(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What to explain besides: a step, a skill, an implementation or a parameter, as of `skillc why`."""

    question: Annotated[str, msgspec.Meta(max_length=200)] = ""
