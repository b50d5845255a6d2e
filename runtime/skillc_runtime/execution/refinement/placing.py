"""Where things are put down: the places that a skill text may choose among are tried, the best first."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import islice
from typing import Final

from skillc_model.conditions import Expression, Invoke
from skillc_model.skills import Let
from skillc_runtime.execution.refinement.situation import ChosenPlace, Situation
from skillc_runtime.motion.working_face import working_face
from skillc_runtime.world.eval.expressions import value_of
from skillc_runtime.world.space.frames import size
from skillc_runtime.world.space.placing.chosen_places import at_support, list_places, reservation_changes
from skillc_runtime.world.space.placing.place_foresight import PLACE_POSE
from skillc_runtime.world.state.labels.labelling import label
from skillc_runtime.world.state.values import Value

MOST: Final = 64
"""How many places are tried at most."""


def list_values(
    lets: Sequence[Let], here: Situation, values: Mapping[str, Value]
) -> Iterator[tuple[Situation, dict[str, Value]]]:
    """Yield the values by name after some `let`, the best first, each with the situation in which it has been chosen.

    Where a thing is put down several may do, else there is one. EvaluationError if something has no value.
    """
    if not lets:
        yield here, dict(values)
        return
    for there, value in _list_choices(lets[0].value, here, values):
        yield from list_values(lets[1:], there, {**values, lets[0].name: value})


def _list_choices(
    expression: Expression, here: Situation, values: Mapping[str, Value]
) -> Iterator[tuple[Situation, Value]]:
    if not isinstance(expression, Invoke) or not _is_place_pose(expression, here):
        yield here, value_of(expression, here.state, values)
        return
    state, words = here.state, here.state.vocabulary
    arm, gripper, thing, to = (str(value_of(each, state, values)) for each in expression.arguments)
    for each in islice(list_places(state, arm, gripper, thing, to), MOST):
        at, support = at_support(state, each), label(each.support, words)
        middle = (at @ working_face(size(state, thing)).inverse()).position
        chosen = ChosenPlace(label(thing, words), label(to, words), support, at, middle, each.board, each.stated)
        there = here.with_changes(reservation_changes(state, thing, to, each.support, at))
        yield replace(there, places=(*here.places, chosen)), each.tool


def _is_place_pose(call: Invoke, here: Situation) -> bool:
    function = here.state.vocabulary.functions.get(call.function)
    return function is not None and function.python == PLACE_POSE
