"""Plans for a run: looks at each plan in space, from where the arms are, before anything moves."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from functools import partial
from typing import TYPE_CHECKING, TypeAlias

import msgspec

from skillc_model.skills import SkillLibrary
from skillc_model.tree import Node
from skillc_runtime.cancellation import Cancelled, CancelToken
from skillc_runtime.execution.refinement.failure import Cause
from skillc_runtime.execution.refinement.look import AnswerT, PlanLook, PlanWithout, look_at_plans
from skillc_runtime.execution.refinement.look_memory import LookMemory
from skillc_runtime.planning.plan import GaveUp, Step
from skillc_runtime.recording.space_claim import SpaceClaim
from skillc_runtime.world.state.data_sheet import SheetError, sheet_of
from skillc_runtime.world.state.python_calls import FOREIGN_ERRORS
from skillc_runtime.world.state.terms import ARM_DEVICE, CAMERA, CONTAIN, HAS_GRIPPER
from skillc_runtime.world.state.world_state import WorldState

if TYPE_CHECKING:
    from skillc_runtime.devices.cell import Cell
    from skillc_runtime.execution.refinement.situation import Situation

LOOK_S = 5.0
"""For how long plans may be looked at in any case, in s of wall time, also if planning has used up its time."""

MAY_GO: frozenset[Cause] = frozenset(("nothing-fits", "no-value"))
"""The causes after which a step may go nevertheless: they rest on values that a run may sense."""

MAY_GO_IF_SEEN: frozenset[Cause] = MAY_GO | {"no-grasp-or-place"}
"""The same where a camera may find that things are elsewhere than is known."""

AT_HOME_RAD = 0.02
"""How far each joint of an arm at home may be from there, in rad."""


Postures: TypeAlias = Mapping[str, tuple[float, ...]]
"""The joints (nv,) of arms in rad, by IRI."""


class SpaceLook(msgspec.Struct, frozen=True):
    """How plans are looked at: from where the arms are, None for all at home, and where is kept what was found."""

    postures: Postures | None = None
    memory: LookMemory | None = None


def measure_postures(cell: Cell) -> Postures:
    """Return where the arms of a cell are now, without those that the cell lacks.

    Fingers are not read: each reading draws noise, and a repeated run, which does not look, would draw other noise.
    """
    found = dict[str, tuple[float, ...]]()
    for arm in sorted(cell.world.snapshot().instances(ARM_DEVICE)):
        with suppress(KeyError):
            found[arm] = tuple(cell.arm(arm).measured.q.tolist())
    return found


def plan_for_run(
    library: SkillLibrary, state: WorldState, plan: PlanWithout[AnswerT], how: SpaceLook, cancel: CancelToken
) -> tuple[AnswerT | GaveUp, SpaceClaim | None]:
    """Return the first plan whose steps all go in space, or that none is known, and what is known of the plan.

    A plan of which a step lacks only what a run may sense is better than none, and so is one that begins where arms
    were stopped, since they may have a little more room than is known. If a look fails, or takes until `cancel` ends
    it, the plan is returned unchecked. None is known if there is no plan, and where there are no arms.
    """
    if not state.instances(ARM_DEVICE):
        return plan(()), None
    limit: CancelToken | None = None

    def look(steps: Sequence[Step]) -> PlanLook:
        nonlocal limit
        limit = limit or CancelToken(max(LOOK_S, cancel.remaining_s), cancel)
        return _look_safely(
            library, state, how, tuple(steps), partial(_look, library, state, how.postures, limit, steps)
        )

    is_sure = how.postures is None or _are_at_rest(state, how.postures)
    may_go = MAY_GO_IF_SEEN if state.instances(CAMERA) else MAY_GO
    possible: tuple[AnswerT, SpaceClaim] | None = None
    before: PlanLook | None = None
    for answer, seen in look_at_plans(plan, look):
        if seen is None:
            break
        if seen.failed is None:
            return (answer, seen.claim) if possible is None or not seen.claim.stopped else possible
        if possible is None and (seen.cause in may_go or not is_sure):
            possible = answer, seen.claim
        before = seen
    if possible is not None:
        return possible
    return (answer if before is None else before.explain(state)), None


def look_at_body_for_run(
    library: SkillLibrary, state: WorldState, body: Node, how: SpaceLook, cancel: CancelToken
) -> SpaceClaim | None:
    """Return what is known of a body in space, found in LOOK_S; None where there are no arms."""
    if not state.instances(ARM_DEVICE):
        return None
    find = partial(_look_at_body, library, state, how.postures, CancelToken(LOOK_S, cancel), body)
    return _look_safely(library, state, how, body, find).claim


def _are_at_rest(state: WorldState, postures: Postures) -> bool:
    """Whether all arms are at home that have such a posture, with empty hands."""
    for arm, q in postures.items():
        if any(state.objects(gripper, CONTAIN) for gripper in state.objects(arm, HAS_GRIPPER)):
            return False
        with suppress(SheetError):
            home = sheet_of(state, arm).posture("home")
            if len(q) != len(home) or any(abs(one - other) > AT_HOME_RAD for one, other in zip(q, home, strict=True)):
                return False
    return True


def _look_safely(
    library: SkillLibrary,
    state: WorldState,
    how: SpaceLook,
    what: tuple[Step, ...] | Node,
    find: Callable[[], PlanLook],
) -> PlanLook:
    """Return what a look at a plan or a body finds; if it fails or ends early, that it has."""
    try:
        return find() if how.memory is None else how.memory.recall(library, state, how.postures, what, find)
    except Cancelled as why:
        stopped = str(why)
    except FOREIGN_ERRORS as error:  # whatever fails in it is no reason not to do what planners have proved
        stopped = f"the look has failed: {type(error).__name__}: {error}"
    steps = len(what) if isinstance(what, tuple) else 1
    return PlanLook(claim=SpaceClaim(checked=0, steps=steps, stopped=stopped, from_home=how.postures is None))


def _look(
    library: SkillLibrary, state: WorldState, postures: Postures | None, limit: CancelToken, steps: Sequence[Step]
) -> PlanLook:
    # The simulator is slow to import.
    from skillc_runtime.execution.refinement.replanning import look_at_plan

    return look_at_plan(library, _begin(state, postures), postures is None, steps, limit)


def _look_at_body(
    library: SkillLibrary, state: WorldState, postures: Postures | None, limit: CancelToken, body: Node
) -> PlanLook:
    # The simulator is slow to import.
    from skillc_runtime.execution.refinement.replanning import look_at_body

    return look_at_body(library, _begin(state, postures), postures is None, body, limit)


def _begin(state: WorldState, postures: Postures | None) -> Situation:
    # The simulator is slow to import.
    from skillc_runtime.execution.refinement.situation import begin_at, begin_at_home

    return begin_at_home(state) if postures is None else begin_at(state, postures)
