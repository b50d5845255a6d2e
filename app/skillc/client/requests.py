"""Makes the requests of a client from what a program asks for; RequestError for a value that cannot be meant."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import datetime
from typing import Any, Literal

from skillc.contract.operation import OperationRequest
from skillc.contract.order import Missed, OrderRequest
from skillc.contract.plan import PlanRequest
from skillc.contract.rehearsal import RehearsalRequest
from skillc.contract.trials import TRIAL_LIMIT_S, TrialDisturbance, TrialsRequest
from skillc.errors import RequestError
from skillc.values.arguments import (
    optional_seconds,
    optional_text,
    read_arguments,
    require_choice,
    require_count,
    require_text,
)
from skillc.values.keywords import read_keywords
from skillc.values.run_keywords import OrderKeywords

PLANNING_S, REHEARSAL_S = 30.0, 600.0

Arguments = Mapping[str, Any] | None
"""The values of a task's parameters by name."""


def describe_operation(task: str | None, settings: Mapping[str, Any], known: type) -> OperationRequest:
    """Return a request for exactly one of a task, a goal and a skill call, as keyword arguments say."""
    request = read_keywords(OperationRequest, settings, known, task)
    if [request.task, request.goal, request.call].count(None) != 2:
        raise RequestError("name exactly one of a task, a goal and a skill call")
    return request


def describe_order(request: OperationRequest, at: datetime, times: OrderKeywords) -> OrderRequest:
    """Return a request to submit something at a time, once or repeatedly."""
    until, missed = times.get("until"), times.get("missed", "run-once")
    if at.tzinfo is None or (until is not None and until.tzinfo is None):
        raise RequestError("`at` and `until` need their offset from UTC, such as `datetime.now(UTC)` has")
    choice, every_s = require_choice(missed, Missed, "`missed`"), optional_seconds(times.get("every_s"), "`every_s`")
    return OrderRequest(request, at, every_s, until, times.get("count"), choice)


def describe_plan(
    cell: str,
    task: str | None,
    goal: str | None,
    arguments: Arguments,
    minimise: Literal["work", "makespan"],
    prove: bool,
    deadline_s: float,
    geometry: bool,
) -> PlanRequest:
    """Return a request for a plan."""
    return PlanRequest(
        cell=cell,
        task=optional_text(task, "the task"),
        goal=optional_text(goal, "the goal"),
        arguments=read_arguments(arguments),
        minimise=require_choice(minimise, Literal["work", "makespan"], "`minimise`"),
        prove=prove,
        deadline_s=optional_seconds(deadline_s, "`deadline_s`") or PLANNING_S,
        geometry=geometry,
    )


def describe_rehearsal(
    cell: str,
    task: str | None,
    goal: str | None,
    call: str | None,
    arguments: Arguments,
    seed: int,
    deadline_s: float | None,
    film: bool,
) -> RehearsalRequest:
    """Return a request for a rehearsal, with a film of it."""
    return RehearsalRequest(
        cell=cell,
        task=optional_text(task, "the task"),
        goal=optional_text(goal, "the goal"),
        call=optional_text(call, "the skill call"),
        arguments=read_arguments(arguments),
        seed=seed,
        deadline_s=optional_seconds(deadline_s, "`deadline_s`") or REHEARSAL_S,
        film=film,
    )


def describe_trials(
    cell: str,
    task: str,
    arguments: Arguments,
    number: int,
    seed: int,
    disturb: TrialDisturbance,
    deadline_s: float | None,
) -> TrialsRequest:
    """Return a request for a series of trials."""
    return TrialsRequest(
        cell=cell,
        task=require_text(task, "the task"),
        arguments=read_arguments(arguments),
        number=require_count(number, "the number of trials", 1),
        seed=require_count(seed, "the seed", 0),
        disturb=require_choice(disturb, TrialDisturbance, "`disturb`"),
        deadline_s=optional_seconds(deadline_s, "`deadline_s`") or TRIAL_LIMIT_S,
    )
