"""Reads requested texts in a thread of its own: one that takes long holds up no tick of the cell."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from queue import SimpleQueue
from threading import Thread

from skillc.cells.operations.assigning import assign_request
from skillc.contract.messages import Submit
from skillc.contract.operation import OperationRequest
from skillc.errors import RequestError, ServiceError
from skillc_model.skills import SkillLibrary
from skillc_runtime.execution.assignment import Assignment
from skillc_runtime.world.state.world_state import WorldState


@dataclass(frozen=True, slots=True)
class Assigned:
    """What a request with a number asks for, read with a library; or why it cannot be."""

    number: int
    message: Submit
    library: SkillLibrary
    result: Assignment | ServiceError


class Assigner:
    """The thread, and what it has read; `wake` is called whenever there is something to take."""

    def __init__(self, wake: Callable[[], None]) -> None:
        self._wake = wake
        self._waiting = SimpleQueue[tuple[int, Submit, SkillLibrary, WorldState]]()
        self._assigned = deque[Assigned]()
        Thread(target=self._run, daemon=True).start()

    def begin(self, number: int, message: Submit, library: SkillLibrary, state: WorldState) -> None:
        """Read a request, after those before it."""
        self._waiting.put((number, message, library, state))  # wait ends: at once, the queue has no limit

    @property
    def ready(self) -> bool:
        """Whether there is something to take."""
        return bool(self._assigned)

    def take(self) -> Assigned | None:
        """Return the next request that was read; None if there is none yet."""
        return self._assigned.popleft() if self._assigned else None

    def _run(self) -> None:
        while True:
            number, message, library, state = self._waiting.get()  # wait ends: with the process
            self._assigned.append(Assigned(number, message, library, _assign(message.request, library, state)))
            self._wake()


def _assign(request: OperationRequest, library: SkillLibrary, state: WorldState) -> Assignment | ServiceError:
    try:
        return assign_request(request.task, request.goal, request.call, request.arguments, library, state)
    except ServiceError as error:
        return error
    except RecursionError:
        return RequestError("it is nested too deeply")
