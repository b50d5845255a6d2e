"""A cell of a server; made from `async_cell` by `python tests/accept.py`, not edited."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from datetime import datetime
from pathlib import Path
from typing import Any, Unpack

from skillc.client.async_cell import OPERATIONS, PLANNING_S, TRIALS, WRITES
from skillc.client.operation import ServerOperation
from skillc.client.waiting import WaitingCell
from skillc.contract.cell import (
    CellCheckpoint,
    CellStatus,
    Disturbance,
    Lease,
)
from skillc.contract.device import DeviceStatus
from skillc.contract.geometry import CellModel, SurfaceCoverage
from skillc.contract.job import (
    Job,
    TaskResult,
)
from skillc.contract.learning import LearnResult
from skillc.contract.library import LibraryDescription
from skillc.contract.operation import OperationStatus
from skillc.contract.order import Order
from skillc.contract.plan import PlanMeasure, PlanPreview
from skillc.contract.sample import Sample
from skillc.contract.trials import TrialDisturbance
from skillc.contract.world import (
    PlacedThing,
    QueryRows,
    WorldFact,
    WorldFormat,
    WorldWrite,
)
from skillc.values.run_keywords import LearnKeywords, OperationKeywords, OrderKeywords
from skillc.values.trials import Trials


class ServerCell(WaitingCell):
    """A cell of a server; its methods are those of `AsyncCell`, and wait."""

    def acknowledge(self) -> CellStatus:
        """Let a cell take operations again after a fault or a stop whose cause is removed."""
        return self._loop.run(self._client.acknowledge())

    def stop(self, reason: str = "stopped") -> CellStatus:
        """Stop all operations of a cell.

        Why an operation, or everything, is stopped. A long reason is cut, and what else a body has is ignored.
        """
        return self._loop.run(self._client.stop(reason))

    def reset(self, why: str = "") -> CellStatus:
        """Reset a simulated cell to its scene: its world and its reality.

        The reason for a reset or a restore, for the history of the world.
        """
        return self._loop.run(self._client.reset(why))

    def checkpoints(self) -> tuple[CellCheckpoint, ...]:
        """List the checkpoints of a simulated cell, by name."""
        return self._loop.run(self._client.checkpoints())

    def save(self, name: str) -> CellCheckpoint:
        """Save a simulated cell, its world and its reality, as a checkpoint.

        The name of a new checkpoint: letters, digits, `_`, `-` and `.`.
        """
        return self._loop.run(self._client.save(name))

    def restore(self, checkpoint: str, why: str = "") -> CellStatus:
        """Restore a simulated cell from a checkpoint.

        The reason for a reset or a restore, for the history of the world.
        """
        return self._loop.run(self._client.restore(checkpoint, why))

    def remove_checkpoint(self, checkpoint: str) -> None:
        """Remove a checkpoint of a simulated cell."""
        self._loop.run(self._client.remove_checkpoint(checkpoint))

    def model(self) -> CellModel:
        """Show the shapes and joints of a simulated cell, as they really are."""
        return self._loop.run(self._client.model())

    def poses(self) -> dict[str, tuple[float, float, float, float, float, float, float]]:
        """List where the world of a cell has individuals, by IRI."""
        return self._loop.run(self._client.poses())

    def coverage(self) -> dict[str, SurfaceCoverage]:
        """Show where tools have really worked on surfaces."""
        return self._loop.run(self._client.coverage())

    def take_lease(self, duration_s: float = 60.0, takeover: bool = False) -> Lease:
        """Take the lease of a cell, or prolong it.

        For how long a client wants to command a cell alone, in s; `takeover` ends the lease of another client.
        """
        return self._loop.run(self._client.take_lease(duration_s, takeover))

    def release_lease(self) -> None:
        """Give the lease of a cell back."""
        self._loop.run(self._client.release_lease())

    def orders(self) -> tuple[Order, ...]:
        """List the orders for a cell."""
        return self._loop.run(self._client.orders())

    def queue(self) -> tuple[OperationStatus, ...]:
        """List the operations that wait in a cell, in the order in which they get planners and devices."""
        return self._loop.run(self._client.queue())

    def reorder(self, first: tuple[str, ...]) -> tuple[OperationStatus, ...]:
        """Put operations before all others that wait in a cell, whatever their priority.

        The ids of the operations that come first among those that wait in a cell, in this order.
        """
        return self._loop.run(self._client.reorder(first))

    def things(self) -> tuple[PlacedThing, ...]:
        """List what has a place or a size in a cell, as it is believed."""
        return self._loop.run(self._client.things())

    def place_thing(self, thing: str, pose: tuple[float, float, float, float, float, float, float], why: str) -> None:
        """Say where a thing is in the world of a cell; nothing moves.

        Where a thing is, and why this is said: its position in m and a quaternion (w, x, y, z), in the world.

        It stays with what carries it. `thing` is an IRI or `prefix:name`.
        """
        self._loop.run(self._client.place_thing(thing, pose, why))

    def library(self) -> LibraryDescription:
        """Describe the library of a cell."""
        return self._loop.run(self._client.library())

    def robots(self) -> tuple[DeviceStatus, ...]:
        """List the devices of a cell, and which operation holds each."""
        return self._loop.run(self._client.robots())

    def start(
        self, task: str | None = None, *, key: str | None = None, **settings: Unpack[OperationKeywords]
    ) -> ServerOperation:
        """Submit a task of the cell's library, a goal or a skill call, and return the operation.

        `arguments` are the values of the task's parameters by name. With `approve` each plan waits for approval; with
        `ask_after_failure` a failed step waits for a decision. Of operations that wait for devices a higher `priority`
        comes first. The operation fails if it has not ended `deadline_s` s of the cell's time after this, and a
        primitive or a wait if it has not ended `step_deadline_s` s after its start. It pauses before its first call
        with `step`, and before each SKILL or FILE:LINE of `breakpoints`. The same `key` twice is one operation.
        """
        return ServerOperation(self._loop, self._loop.run(self._client.start(task, key=key, **settings)))

    def order(
        self, task: str | None = None, *, at: datetime, key: str | None = None, **settings: Unpack[OrderKeywords]
    ) -> Order:
        """Let the server submit a task, a goal or a skill call `at` a time, with its offset from UTC.

        It is submitted again every `every_s` s, `count` times or `until` a time. If that was not possible within 60 s,
        the last one that was missed is submitted as soon as it is, or none with `missed="skip"`. The other parameters
        are those of `start`.
        """
        return self._loop.run(self._client.order(task, at=at, key=key, **settings))

    def remove_order(self, order: str) -> None:
        """Forget an order by its id; what it has submitted goes on."""
        self._loop.run(self._client.remove_order(order))

    def operations(self, limit: int = OPERATIONS, ongoing: bool = False) -> tuple[ServerOperation, ...]:
        """Return its last operations, the last one first; with `ongoing` all that have not ended, and no others."""
        return tuple(
            ServerOperation(self._loop, each) for each in self._loop.run(self._client.operations(limit, ongoing))
        )

    def set_pace(self, pace: float | str) -> CellStatus:
        """Let its time pass `fast`, as fast as it computes, `real`, as real time, or so many times as fast."""
        return self._loop.run(self._client.set_pace(pace))

    def disturb(self, disturbance: Disturbance) -> CellStatus:
        """Let something happen to it that no skill does, if it is simulated, such as a `skillc.devices.PushArm`."""
        return self._loop.run(self._client.disturb(disturbance))

    def plan(
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
        return self._loop.run(
            self._client.plan(
                task,
                arguments=arguments,
                goal=goal,
                minimise=minimise,
                prove=prove,
                deadline_s=deadline_s,
                geometry=geometry,
            )
        )

    def rehearse(
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
        return self._loop.run(
            self._client.rehearse(
                task,
                arguments=arguments,
                goal=goal,
                call=call,
                seed=seed,
                deadline_s=deadline_s,
                answers=answers,
                film=film,
            )
        )

    def trials(
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
        return self._loop.run(
            self._client.trials(
                task, number, arguments=arguments, seed=seed, disturb=disturb, deadline_s=deadline_s, watch=watch
            )
        )

    def learn(
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
        return self._loop.run(self._client.learn(task, arguments=arguments, watch=watch, **settings))

    def facts(
        self, subject: str | None = None, type: str | None = None, search: str | None = None
    ) -> tuple[WorldFact, ...]:
        """Return the facts about all individuals, about one, or about those of a class, with how each is known.

        With `search` only those about individuals whose names, labels, classes or texts contain these words.
        """
        return self._loop.run(self._client.facts(subject, type, search))

    def query(self, sparql: str) -> QueryRows:
        """Answer a SPARQL query about its world."""
        return self._loop.run(self._client.query(sparql))

    def export(self, format: WorldFormat = "turtle", everything: bool = False) -> str:
        """Return its world as RDF, or as the picture `graph` or `top-view`, an SVG document.

        RDF has the facts of data sheets with `everything`.
        """
        return self._loop.run(self._client.export(format, everything))

    def edit(self, *edits: str, why: str) -> None:
        """Change its world in one transaction, as you state, by edits as of `skillc scene edit`; `why` is recorded."""
        self._loop.run(self._client.edit(*edits, why=why))

    def world_history(self, limit: int = WRITES, before: int | None = None) -> tuple[WorldWrite, ...]:
        """Return the last writes to its world, or those before a number, the last one first."""
        return self._loop.run(self._client.world_history(limit, before))

    def samples(self, rate_hz: float = 10.0) -> Iterator[Sample]:
        """Yield what moves in it, `rate_hz` times a second at most, up to 50; who takes them slowly gets fewer."""
        return self._loop.iterate(self._client.samples(rate_hz))
