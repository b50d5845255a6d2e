"""What looking at tasks in space finds, which is stored: it imports the simulator, plans and searches postures.

An answer depends on the scene, of the goal or body, of what planners read of the skills that they may
use or that change something, and of the user's models and Python. It holds the digest of the skills that were looked
into, with their bodies.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import msgspec

from skillc.services.library.answer_store import digest_parts
from skillc.services.library.check_inputs import describe_scene, digest_modules, encode_meaning
from skillc.services.library.modules import find_modules
from skillc.services.tasks.space_problems import OutOfTime, SpaceProblem
from skillc_dsl.query import Store
from skillc_model.planning_view import encode_view
from skillc_model.skills import Compound, SkillLibrary, Task
from skillc_model.traversal import find_calls
from skillc_rdf.vocabulary.closure import reachable
from skillc_runtime.cancellation import Cancelled, CancelToken
from skillc_runtime.scene.load import LoadedScene
from skillc_runtime.world.state.terms import ARM_DEVICE

LIMIT_S = 60.0
"""How long all tasks of a library are looked at together."""


class Look(msgspec.Struct, frozen=True):
    """What was found, the skills that the task calls, and the digest of these and of all that they call."""

    problem: SpaceProblem | None
    skills: tuple[str, ...]
    bodies: str


class TaskLooks:
    """Looks at tasks in space, together for at most LIMIT_S; in the store is what was found before.

    `looked` are the skills so far on whose bodies depends what was found; `in_time` is whether none was given up.
    """

    def __init__(self, store: Store | None) -> None:
        self._store = store
        self._cancel: CancelToken | None = None
        self.looked = frozenset[str]()
        self.in_time = True

    def judge(self, library: SkillLibrary, scene: LoadedScene, task: Task) -> SpaceProblem | OutOfTime | None:
        """Return the step of a task that does not go in its scene; None if nothing is known against any."""
        if not scene.state.instances(ARM_DEVICE):
            return None
        inputs = tuple(_inputs(library, scene, task)) if self._store else ()
        known = self._store.load("look", inputs) if self._store else None
        entry = known if isinstance(known, Look) else None
        if entry is None or entry.bodies != _digest_bodies(library, entry.skills):
            entry = self._look(library, scene, task)
            if entry is None:
                self.in_time = False
                return OutOfTime(LIMIT_S)
            if self._store:
                self._store.save("look", inputs, entry)
        self.looked |= _called(library, entry.skills)
        return entry.problem

    def _look(self, library: SkillLibrary, scene: LoadedScene, task: Task) -> Look | None:
        """Look at a task; None if the time is over."""
        # The simulator is slow to import.
        from skillc.services.space.look import look_at_task

        self._cancel = self._cancel or CancelToken(LIMIT_S)
        try:
            found = look_at_task(library, scene.state, task, self._cancel, self._store is not None)
        except Cancelled:
            return None
        skills = tuple(sorted(found.skills))
        return Look(found.problem, skills, _digest_bodies(library, skills))


def _inputs(library: SkillLibrary, scene: LoadedScene, task: Task) -> Iterator[str | bytes]:
    """Yield everything that a look depends on but the bodies of skills, and skills that only calls lead to."""
    yield from describe_scene(scene)
    yield encode_meaning((task.goal, task.body, task.always))
    for name, skill in sorted(library.skills.items()):
        implementations = library.implementations_of(name)
        if skill.planned or skill.results or any(each.post for each in implementations):
            yield encode_view(skill, implementations)
    yield from digest_modules(find_modules(library))


def _called(library: SkillLibrary, skills: Iterable[str]) -> frozenset[str]:
    """Return skills and all that their bodies call."""

    def calls(skill: str) -> Iterator[str]:
        for each in library.implementations_of(skill):
            if isinstance(each.body, Compound):
                yield from (call.skill for call in find_calls(each.body.node))

    return frozenset(reachable((each for each in skills if each in library.skills), calls))


def _digest_bodies(library: SkillLibrary, skills: Iterable[str]) -> str:
    called = sorted(_called(library, skills))
    return digest_parts(encode_meaning((library.skills[each], library.implementations_of(each))) for each in called)
