"""The pages for people: quantities in readable units, sentences whole."""

from __future__ import annotations

import msgspec
import pytest

from emit.samples import HERE, holds, wiping
from skillc_compiler.emit import docs
from skillc_compiler.emit.docs import format_quantities
from skillc_model.skills import Task
from skillc_rdf.vocabulary.types import NumberType


@pytest.mark.parametrize(
    ("dimension", "values", "texts"),
    [
        ("Length", (0.015, 0.0, 0.05), ("15 mm", "0 mm", "50 mm")),
        ("Length", (0.12, None, 3.0), ("0.12 m", "", "3 m")),
        ("Length", (0.0, 0.0, 2.0), ("0 m", "0 m", "2 m")),
        ("Angle", (0.5235987755982988,), ("30 deg",)),
        ("Force", (0.05, 20.0), ("0.05 N", "20 N")),
        ("Number", (0.25,), ("0.25",)),
    ],
)
def test_values_of_a_parameter_share_a_readable_unit(
    dimension: str, values: tuple[float | None, ...], texts: tuple[str, ...]
) -> None:
    assert format_quantities(values, NumberType(dimension)) == texts


@pytest.mark.parametrize(
    ("doc", "line"),
    [("", "- fetch. Goal: `arm hold cup`."), ("Fetch it.", "- fetch: Fetch it. Goal: `arm hold cup`.")],
)
def test_the_list_of_tasks_is_punctuated(doc: str, line: str) -> None:
    task = Task(name="fetch", doc=doc, goal=holds("arm contain object"), goal_text="arm hold cup", source=HERE)
    made = msgspec.structs.replace(wiping(), tasks={"fetch": task})
    assert line in docs.emit(made)["docs/index.md"].splitlines()
