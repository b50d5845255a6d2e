"""A cell of a server, for programs with asyncio."""

from __future__ import annotations

from collections.abc import AsyncGenerator, Callable, Mapping, Sequence
from datetime import datetime
from math import isinf
from pathlib import Path
from typing import Any, Unpack
from uuid import uuid4

from skillc.client.async_operation import AsyncOperation
from skillc.client.calls import CellCalls
from skillc.client.experiments import run_job
from skillc.client.feed import follow_samples
from skillc.contract.api.endpoints import (
    ADD_ORDER,
    DISTURB_CELL,
    EDIT_WORLD,
    LIST_FACTS,
    LIST_OPERATIONS,
    LIST_WRITES,
    QUERY_WORLD,
    READ_JOB_FILE,
    REMOVE_JOB,
    REMOVE_ORDER,
    SET_PACE,
    SUBMIT_OPERATION,
    WRITE_WORLD,
)
from skillc.contract.cell import CellStatus, Disturbance, PaceSetting
from skillc.contract.job import FILM, Job, PlanResult, RunResult, TaskResult, TrialsResult
from skillc.contract.learning import LearnRequest, LearnResult, LearnSpec
from skillc.contract.operation import OperationRequest
from skillc.contract.order import Missed, Order, OrderRequest
from skillc.contract.plan import PlanMeasure, PlanPreview, PlanRequest
from skillc.contract.rehearsal import RehearsalRequest
from skillc.contract.runs.history import HistoryPage
from skillc.contract.sample import Sample
from skillc.contract.trials import TRIAL_LIMIT_S, TrialDisturbance, TrialsRequest
from skillc.contract.world import (
    DocumentForm,
    FactPage,
    QueryRows,
    WorldEdit,
    WorldFact,
    WorldFormat,
    WorldQuery,
    WorldWrite,
    WritePage,
)
from skillc.errors import RequestError
from skillc.values.arguments import (
    optional_seconds,
    optional_text,
    read_arguments,
    read_pace,
    require_choice,
    require_count,
    require_text,
)
from skillc.values.keywords import read_keywords
from skillc.values.run_keywords import LearnKeywords, OperationKeywords, OrderKeywords
from skillc.values.trials import Trials

OPERATIONS, WRITES, TRIALS, FACTS = 100, 100, 50, 1000
PLANNING_S, REHEARSAL_S = 30.0, 600.0


class AsyncCell(CellCalls):
    """A cell of a server. Errors are those of `AsyncOperation`."""

    async def start(
        self, task: str | None = None, *, key: str | None = None, **settings: Unpack[OperationKeywords]
    ) -> AsyncOperation:
        """Submit a task of the cell's library, a goal or a skill call, and return the operation.

        `arguments` are the values of the task's parameters by name. With `approve` each plan waits for approval; with
        `ask_after_failure` a failed step waits for a decision. Of operations that wait for devices a higher `priority`
        comes first. The operation fails if it has not ended `deadline_s` s of the cell's time after this, and a
        primitive or a wait if it has not ended `step_deadline_s` s after its start. It pauses before its first call
        with `step`, and before each SKILL or FILE:LINE of `breakpoints`. The same `key` twice is one operation.
        """
        request = _describe_operation(task, settings, OperationKeywords)
        status = await self._connection.call(SUBMIT_OPERATION, self.name, body=request, key=key or str(uuid4()))
        return AsyncOperation(self._connection, status)

    async def order(
        self, task: str | None = None, *, at: datetime, key: str | None = None, **settings: Unpack[OrderKeywords]
    ) -> Order:
        """Let the server submit a task, a goal or a skill call `at` a time, with its offset from UTC.

        It is submitted again every `every_s` s, `count` times or `until` a time. If that was not possible within 60 s,
        the last one that was missed is submitted as soon as it is, or none with `missed="skip"`. The other parameters
        are those of `start`.
        """
        order = _describe_order(_describe_operation(task, settings, OrderKeywords), at, settings)
        return await self._connection.call(ADD_ORDER, self.name, body=order, key=key or str(uuid4()))

    async def remove_order(self, order: str) -> None:
        """Forget an order by its id; what it has submitted goes on."""
        await self._connection.call(REMOVE_ORDER, order)

    async def operations(self, limit: int = OPERATIONS, ongoing: bool = False) -> tuple[AsyncOperation, ...]:
        """Return its last operations, the last one first; with `ongoing` all that have not ended, and no others."""
        found = await self._connection.call(LIST_OPERATIONS, self.name, query=HistoryPage(limit=limit, ongoing=ongoing))
        return tuple(AsyncOperation(self._connection, each) for each in found)

    async def set_pace(self, pace: float | str) -> CellStatus:
        """Let its time pass `fast`, as fast as it computes, `real`, as real time, or so many times as fast."""
        setting = PaceSetting(None if isinf(factor := read_pace(pace)) else factor)
        return await self._connection.call(SET_PACE, self.name, body=setting)

    async def disturb(self, disturbance: Disturbance) -> CellStatus:
        """Let something happen to it that no skill does, if it is simulated, such as a `skillc.devices.PushArm`."""
        return await self._connection.call(DISTURB_CELL, self.name, body=disturbance)

    async def plan(
        self,
        task: str | None = None,
        *,
        arguments: Mapping[str, Any] | None = None,
        goal: str | None = None,
        minimise: PlanMeasure | None = None,
        prove: bool = False,
        deadline_s: float = PLANNING_S,
        geometry: bool = True,
    ) -> PlanPreview:
        """Plan for a task of the cell's library, or a goal, as its world is now; parameters as of `skillc.plan`."""
        request = PlanRequest(
            cell=self.name,
            task=optional_text(task, "the task"),
            goal=optional_text(goal, "the goal"),
            arguments=read_arguments(arguments),
            minimise=None if minimise is None else require_choice(minimise, PlanMeasure, "`minimise`"),
            prove=prove,
            deadline_s=optional_seconds(deadline_s, "`deadline_s`") or PLANNING_S,
            geometry=geometry,
        )
        job, outcome = await run_job(self._connection, request, PlanResult)
        await self._connection.call(REMOVE_JOB, job.id)
        return outcome.plan

    async def rehearse(
        self,
        task: str | None = None,
        *,
        arguments: Mapping[str, Any] | None = None,
        goal: str | None = None,
        call: str | None = None,
        seed: int = 0,
        deadline_s: float | None = None,
        answers: Sequence[str] = (),
        film: str | Path | None = None,
    ) -> TaskResult:
        """Do in a simulated twin of the cell, as it is known now, what `start` would do; return how that ended.

        `seed` determines how the reality of the twin differs from the facts, `deadline_s` is in its time. What skills
        ask is answered by the first of `answers` that is a choice, else by its default; without either the twin stops.
        With `film` a film is written to this MP4 file, unless nothing has moved. RefusedError if the request cannot be
        carried out.
        """
        request = RehearsalRequest(
            cell=self.name,
            task=optional_text(task, "the task"),
            goal=optional_text(goal, "the goal"),
            call=optional_text(call, "the skill call"),
            arguments=read_arguments(arguments),
            seed=seed,
            deadline_s=optional_seconds(deadline_s, "`deadline_s`") or REHEARSAL_S,
            answers=tuple(answers),
            film=film is not None,
        )
        job, outcome = await run_job(self._connection, request, RunResult)
        if film is not None and FILM in job.files:
            await self._connection.download(READ_JOB_FILE, job.id, FILM, file=Path(film))
        await self._connection.call(REMOVE_JOB, job.id)
        return outcome.run

    async def trials(
        self,
        task: str,
        number: int = TRIALS,
        *,
        arguments: Mapping[str, Any] | None = None,
        seed: int = 0,
        disturb: TrialDisturbance = "none",
        deadline_s: float | None = None,
        watch: Callable[[Job], None] | None = None,
    ) -> Trials:
        """Run a task with `number` successive seeds from the cell's scene, and judge the runs; as `skillc.trials`.

        The cell itself does nothing, and its world now does not matter. One trial may take `deadline_s` s of wall time.
        `watch` is called with each progress. The server keeps the job; it is cancelled if this is.
        RefusedError if the trials cannot be run.
        """
        request = TrialsRequest(
            cell=self.name,
            task=require_text(task, "the task"),
            arguments=read_arguments(arguments),
            number=require_count(number, "the number of trials", 1),
            seed=require_count(seed, "the seed", 0),
            disturb=require_choice(disturb, TrialDisturbance, "`disturb`"),
            deadline_s=optional_seconds(deadline_s, "`deadline_s`") or TRIAL_LIMIT_S,
        )
        _, outcome = await run_job(self._connection, request, TrialsResult, watch)
        return Trials(outcome.series)

    async def learn(
        self,
        task: str,
        *,
        arguments: Mapping[str, Any] | None = None,
        watch: Callable[[Job], None] | None = None,
        **settings: Unpack[LearnKeywords],
    ) -> LearnResult:
        """Learn parameters of skills from trials of a task in the cell's scene; as `skillc.learn`.

        The cell itself does nothing, and no text of its library changes: there is no `apply`. `watch` is called with
        each progress. The server keeps the job with its page, `learned.html`; it is cancelled if this is.
        RefusedError if nothing can be learned in this way.
        """
        request = LearnRequest(
            cell=self.name,
            task=require_text(task, "the task"),
            arguments=read_arguments(arguments),
            spec=read_keywords(LearnSpec, settings, LearnKeywords),
        )
        return (await run_job(self._connection, request, LearnResult, watch))[1]

    async def facts(
        self, subject: str | None = None, type: str | None = None, search: str | None = None
    ) -> tuple[WorldFact, ...]:
        """Return the facts about all individuals, about one, or about those of a class, with how each is known.

        With `search` only those about individuals whose names, labels, classes or texts contain these words.
        """
        found: list[WorldFact] = []
        while True:
            wanted = FactPage(subject, type, search, len(found), FACTS)
            page = await self._connection.call(LIST_FACTS, self.name, query=wanted)
            found += page.facts
            if len(found) >= page.total or not page.facts:
                return tuple(found)

    async def query(self, sparql: str) -> QueryRows:
        """Answer a SPARQL query about its world."""
        query = WorldQuery(require_text(sparql, "the query"))
        return await self._connection.call(QUERY_WORLD, self.name, body=query)

    async def export(self, format: WorldFormat = "turtle", everything: bool = False) -> str:
        """Return its world as RDF, or as the picture `graph` or `top-view`, an SVG document.

        RDF has the facts of data sheets with `everything`.
        """
        choice = require_choice(format, WorldFormat, "`format`")
        form = DocumentForm(choice, everything)
        return (await self._connection.call(WRITE_WORLD, self.name, query=form)).text

    async def edit(self, *edits: str, why: str) -> None:
        """Change its world in one transaction, as you state, by edits as of `skillc scene edit`; `why` is recorded."""
        wanted = WorldEdit(tuple(edits), require_text(why, "`why`"))
        await self._connection.call(EDIT_WORLD, self.name, body=wanted)

    async def world_history(self, limit: int = WRITES, before: int | None = None) -> tuple[WorldWrite, ...]:
        """Return the last writes to its world, or those before a number, the last one first."""
        return await self._connection.call(LIST_WRITES, self.name, query=WritePage(before, limit))

    def samples(self, rate_hz: float = 10.0) -> AsyncGenerator[Sample, None]:
        """Yield what moves in it, `rate_hz` times a second at most, up to 50; who takes them slowly gets fewer."""
        return follow_samples(self._connection, self.name, rate_hz)


def _describe_operation(task: str | None, settings: Mapping[str, Any], known: type) -> OperationRequest:
    """Return a request for exactly one of a task, a goal and a skill call, as keyword arguments say."""
    request = read_keywords(OperationRequest, settings, known, task)
    if [request.task, request.goal, request.call].count(None) != 2:
        raise RequestError("name exactly one of a task, a goal and a skill call")
    return request


def _describe_order(request: OperationRequest, at: datetime, times: OrderKeywords) -> OrderRequest:
    """Return a request to submit something at a time, once or repeatedly."""
    until, missed = times.get("until"), times.get("missed", "run-once")
    if at.tzinfo is None or (until is not None and until.tzinfo is None):
        raise RequestError("`at` and `until` need their offset from UTC, such as `datetime.now(UTC)` has")
    choice, every_s = require_choice(missed, Missed, "`missed`"), optional_seconds(times.get("every_s"), "`every_s`")
    return OrderRequest(request, at, every_s, until, times.get("count"), choice)
