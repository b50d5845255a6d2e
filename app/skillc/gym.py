"""Gymnasium environments in which a policy steers the search of a task, such as that of a peg for its hole."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from skillc.api.boundary import NoticeList, api_call
from skillc.errors import RequestError, ServiceError
from skillc.extras import naming_extras
from skillc.services.project.project import DEFAULT_BACKEND
from skillc.services.run.real_devices import require_reality
from skillc.services.scene.stores import load_world
from skillc.services.tasks.listing import require_task
from skillc.services.tasks.loading import find_task_in_scene
from skillc.services.trials.running import bind_trial_task
from skillc.values.arguments import require_text
from skillc_runtime.devices.reality import set_reality
from skillc_runtime.evaluation.episodes import Episodes, NotSteered, steer_library
from skillc_runtime.evaluation.trials.experiment import NotRecorded, TrialRunner
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.state.data_sheet import SheetError

with naming_extras():
    import gymnasium

__all__ = ["SearchEnv"]

Observation = NDArray[np.float32]
PERIOD_S, LIMIT_S = 0.05, 20.0
FORCE_N, SUNK_M = 20.0, 0.005
"""The force and the depth that are 1 in an observation."""
SIZE = 9


class SearchEnv(gymnasium.Env[Observation, Observation]):
    """The search of a task, such as that of a peg for its hole, with random worlds as in `skillc trials`.

    `reset` runs the task until the search begins: the skill `steered`, which adds a spiral to what the arm does. From
    there on `step` moves the tool for `period_s` s, and what the skill does otherwise goes on: pressing, yielding,
    limits and stops. The episode ends when the skill `until` has ended; after `limit_s` s it is truncated.

    An action (2,) is the velocity in the plane of the search, as a share of the `speed` that the task gives; one longer
    than 1 is shortened. An observation (9,) is clipped to -1 .. 1: the commanded offset in the plane (2) and where the
    tool is (2), both from where the search began, in radii of the search, how far it has sunk in 5 mm, the force on
    the tool along the axes of the plane and its normal in 20 N (3), and the time in `limit_s`.

    A step gives minus its time in s, and the search that succeeds `limit_s` more. `info` has `outcome`, `found` or
    `given up`, once the episode has ended, and `sim_time_s`.
    """

    metadata = {"render_modes": []}  # noqa: RUF012 - as the base class has it

    def __init__(
        self,
        task: str = "contact:insert_peg",
        *,
        steered: str = "OverlaySpiral",
        until: str = "SinkBelow",
        reality: str | None = None,
        period_s: float = PERIOD_S,
        limit_s: float = LIMIT_S,
    ) -> None:
        """Load and plan the task; errors as of `skillc.start`, RequestError if it has no search that is steered."""
        with api_call():
            library, found, scene, _ = find_task_in_scene(require_task(require_text(task, "the task")), DEFAULT_BACKEND)
            state = load_world(scene, library.vocabulary, NoticeList())
            if reality is not None:
                require_reality(reality, state)
                state = set_reality(state, reality)
            library, name = bind_trial_task(found, library, state, {})
            if until not in library.skills:
                raise RequestError(f"there is no skill `{until}`")
            try:
                library = steer_library(library, steered)
            except NotSteered as error:
                raise RequestError(str(error)) from error
            self._episodes = Episodes(TrialRunner(library, state, name, "none"), until)
        self._period_s, self._limit_s, self._began_s = period_s, limit_s, 0.0
        self._seen = np.zeros(SIZE, np.float32)
        self.action_space = gymnasium.spaces.Box(-1.0, 1.0, (2,), np.float32)
        self.observation_space = gymnasium.spaces.Box(-1.0, 1.0, (SIZE,), np.float32)

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """Begin another world, which `seed` determines; ServiceError if the task ends before its search."""
        super().reset(seed=seed)
        world = int(self.np_random.integers(2**31))
        with api_call():
            try:
                self._episodes.begin(world)
            except (NotSteered, NotRecorded, SheetError, FrameError) as error:
                raise ServiceError(f"world {world} cannot be searched: {error}") from error
        self._began_s = self._episodes.now
        return self._observe(), {"world": world}

    def step(self, action: Observation) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """Move on; RequestError after the end of an episode."""
        search, before_s = self._episodes.search, self._episodes.now
        if search is None:
            raise RequestError("the episode has ended; call reset()")
        search.steer(np.asarray(action, dtype=float))
        self._episodes.advance(self._period_s)
        outcome, time_s = self._episodes.outcome, self._episodes.now - self._began_s
        reward = before_s - self._episodes.now + (self._limit_s if outcome == "found" else 0.0)
        info: dict[str, Any] = {"sim_time_s": time_s, **({"outcome": outcome} if outcome else {})}
        return self._observe(), reward, outcome is not None, outcome is None and time_s >= self._limit_s, info

    def close(self) -> None:
        """End the episode."""
        self._episodes.close()

    def _observe(self) -> Observation:
        """Return what is known now; once the search has ended, what was known before."""
        if (search := self._episodes.search) is not None:
            offset, moved, force = search.observe()
            time = (self._episodes.now - self._began_s) / self._limit_s
            radii = np.concatenate((offset, moved[:2])) / search.radius
            seen = np.concatenate((radii, (-moved[2] / SUNK_M,), force / FORCE_N, (time,)))
            self._seen = np.clip(seen, -1.0, 1.0).astype(np.float32)
        return self._seen
