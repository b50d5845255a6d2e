"""A cell of a server."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from datetime import datetime
from pathlib import Path
from typing import Any, Literal

from skillc.client.async_cell import OPERATIONS, TRIALS, WRITES, AsyncCell
from skillc.client.loop_thread import LoopThread
from skillc.client.operation import ServerOperation
from skillc.client.requests import PLANNING_S
from skillc.contract.cell import CellStatus
from skillc.contract.device import DeviceStatus
from skillc.contract.disturbance import Disturbance
from skillc.contract.lease import Lease
from skillc.contract.library import LibraryDescription
from skillc.contract.order import Missed, Order
from skillc.contract.plan import PlanPreview
from skillc.contract.rehearsal import Rehearsal
from skillc.contract.sample import Sample
from skillc.contract.trials import TrialDisturbance, TrialSeries
from skillc.contract.world import PlacedThing, QueryRows, WorldFact, WorldFormat, WorldWrite
from skillc.values.trials import Trials


class ServerCell:
    """A cell of a server; its methods are those of `AsyncCell`, and wait."""

    def __init__(self, loop: LoopThread, cell: AsyncCell) -> None:
        self._loop, self._cell = loop, cell

    @property
    def name(self) -> str:
        """Its name, which no other cell of the server has."""
        return self._cell.name

    @property
    def status(self) -> CellStatus:
        """How it is now."""
        return self._loop.run(self._cell.status())

    def start(
        self,
        task: str | None = None,
        *,
        arguments: Mapping[str, Any] | None = None,
        goal: str | None = None,
        skill: str | None = None,
        approve: bool = False,
        ask_after_failure: bool = False,
        priority: int = 0,
        deadline_s: float | None = None,
        step_deadline_s: float | None = None,
        step: bool = False,
        pause_at: Sequence[str] = (),
        key: str | None = None,
    ) -> ServerOperation:
        """Submit a task, a goal or a skill call, and return the operation; the parameters are those of `AsyncCell`."""
        starting = self._cell.start(
            task,
            arguments=arguments,
            goal=goal,
            skill=skill,
            approve=approve,
            ask_after_failure=ask_after_failure,
            priority=priority,
            deadline_s=deadline_s,
            step_deadline_s=step_deadline_s,
            step=step,
            pause_at=pause_at,
            key=key,
        )
        return ServerOperation(self._loop, self._loop.run(starting))

    def order(
        self,
        task: str | None = None,
        *,
        at: datetime,
        every_s: float | None = None,
        until: datetime | None = None,
        count: int | None = None,
        missed: Missed = "run-once",
        arguments: Mapping[str, Any] | None = None,
        goal: str | None = None,
        skill: str | None = None,
        approve: bool = False,
        ask_after_failure: bool = False,
        priority: int = 0,
        deadline_s: float | None = None,
        step_deadline_s: float | None = None,
        key: str | None = None,
    ) -> Order:
        """Let the server submit something at a time, once or again; the parameters are those of `AsyncCell`."""
        ordering = self._cell.order(
            task,
            at=at,
            every_s=every_s,
            until=until,
            count=count,
            missed=missed,
            arguments=arguments,
            goal=goal,
            skill=skill,
            approve=approve,
            ask_after_failure=ask_after_failure,
            priority=priority,
            deadline_s=deadline_s,
            step_deadline_s=step_deadline_s,
            key=key,
        )
        return self._loop.run(ordering)

    def orders(self) -> tuple[Order, ...]:
        """Return the orders for it, also the last ones that have ended."""
        return self._loop.run(self._cell.orders())

    def remove_order(self, order: str) -> None:
        """Forget an order by its id; what it has submitted goes on."""
        self._loop.run(self._cell.remove_order(order))

    def operations(self, limit: int = OPERATIONS, ongoing: bool = False) -> tuple[ServerOperation, ...]:
        """Return its last operations, the last one first; with `ongoing` all that have not ended, and no others."""
        found = self._loop.run(self._cell.operations(limit, ongoing))
        return tuple(ServerOperation(self._loop, each) for each in found)

    def library(self) -> LibraryDescription:
        """Return what its next operation runs: the skills and tasks of its library."""
        return self._loop.run(self._cell.library())

    def robots(self) -> tuple[DeviceStatus, ...]:
        """Return its robots, arms, grippers, cameras and sensors, and which operation holds each."""
        return self._loop.run(self._cell.robots())

    def set_pace(self, pace: float | str) -> CellStatus:
        """Let its time pass `fast`, as fast as it computes, `real`, as real time, or so many times as fast."""
        return self._loop.run(self._cell.set_pace(pace))

    def acknowledge(self) -> CellStatus:
        """Let it take operations again after a fault or a stop whose cause is removed."""
        return self._loop.run(self._cell.acknowledge())

    def disturb(self, disturbance: Disturbance) -> CellStatus:
        """Let something happen to it that no skill does, if it is simulated, such as a `skillc.devices.Push`."""
        return self._loop.run(self._cell.disturb(disturbance))

    def plan(
        self,
        task: str | None = None,
        *,
        arguments: Mapping[str, Any] | None = None,
        goal: str | None = None,
        minimise: Literal["work", "makespan"] = "work",
        prove: bool = False,
        deadline_s: float = PLANNING_S,
    ) -> PlanPreview:
        """Plan for a task of the cell's library, or a goal, as its world is now; parameters as of `skillc.plan`."""
        planning = self._cell.plan(
            task, arguments=arguments, goal=goal, minimise=minimise, prove=prove, deadline_s=deadline_s
        )
        return self._loop.run(planning)

    def rehearse(
        self,
        task: str | None = None,
        *,
        arguments: Mapping[str, Any] | None = None,
        goal: str | None = None,
        skill: str | None = None,
        seed: int = 0,
        deadline_s: float | None = None,
        film: str | Path | None = None,
    ) -> Rehearsal:
        """Do in a simulated twin of the cell, as it is known now, what `start` would do; return how that ended.

        `seed` determines how the reality of the twin differs from the facts, `deadline_s` is in its time. With `film`
        a film is written to this MP4 file. RefusedError if the request cannot be carried out.
        """
        rehearsing = self._cell.rehearse(
            task, arguments=arguments, goal=goal, skill=skill, seed=seed, deadline_s=deadline_s, film=film
        )
        return self._loop.run(rehearsing)

    def trials(
        self,
        task: str,
        number: int = TRIALS,
        *,
        arguments: Mapping[str, Any] | None = None,
        seed: int = 0,
        disturb: TrialDisturbance = "none",
        deadline_s: float | None = None,
        watch: Callable[[TrialSeries], None] | None = None,
    ) -> Trials:
        """Run a task many times in simulation, from the cell's scene, and judge the runs; parameters of `AsyncCell`."""
        running = self._cell.trials(
            task, number, arguments=arguments, seed=seed, disturb=disturb, deadline_s=deadline_s, watch=watch
        )
        return self._loop.run(running)

    def facts(
        self, subject: str | None = None, type: str | None = None, search: str | None = None
    ) -> tuple[WorldFact, ...]:
        """Return the facts about all individuals, about one, or about those of a class, with how each is known.

        With `search` only those about individuals whose names, labels, classes or texts contain these words.
        """
        return self._loop.run(self._cell.facts(subject, type, search))

    def export(self, format: WorldFormat = "turtle", everything: bool = False) -> str:
        """Return its world as RDF, or as the picture `graph` or `top-view`, an SVG document.

        RDF has the facts of data sheets with `everything`.
        """
        return self._loop.run(self._cell.export(format, everything))

    def things(self) -> tuple[PlacedThing, ...]:
        """Return what has a place or a size in it, as it is believed."""
        return self._loop.run(self._cell.things())

    def query(self, sparql: str) -> QueryRows:
        """Answer a SPARQL query about its world."""
        return self._loop.run(self._cell.query(sparql))

    def edit(self, *edits: str, why: str) -> None:
        """Change its world in one transaction, as you state, by edits as of `skillc scene edit`; `why` is recorded."""
        self._loop.run(self._cell.edit(*edits, why=why))

    def world_history(self, limit: int = WRITES, before: int | None = None) -> tuple[WorldWrite, ...]:
        """Return the last writes to its world, or those before a number, the last one first."""
        return self._loop.run(self._cell.world_history(limit, before))

    def samples(self, rate_hz: float = 10.0) -> Iterator[Sample]:
        """Yield what moves in it, `rate_hz` times a second at most, up to 50; who takes them slowly gets fewer."""
        return self._loop.iterate(self._cell.samples(rate_hz))

    def stop(self, reason: str = "stopped") -> CellStatus:
        """Stop all its operations."""
        return self._loop.run(self._cell.stop(reason))

    @property
    def lease(self) -> Lease:
        """Who alone may command it now."""
        return self._loop.run(self._cell.lease())

    def take_lease(self, duration_s: float = 60.0, takeover: bool = False) -> Lease:
        """Be the only client that may command it for `duration_s` s from now on; `takeover` ends another's lease."""
        return self._loop.run(self._cell.take_lease(duration_s, takeover))

    def release_lease(self) -> None:
        """Let others command it again."""
        self._loop.run(self._cell.release_lease())
