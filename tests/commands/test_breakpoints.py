"""What `--breakpoints` takes: skills of the library, and lines with a call; others are refused with what is near."""

from __future__ import annotations

from functools import cache

import pytest

from skillc.errors import RequestError
from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import SHIPPED, find_library
from skillc.services.tasks.breakpoints import parse_breakpoints
from skillc_dsl.position import Position
from skillc_model.skills import Compound, SkillLibrary
from skillc_model.traversal import find_calls
from skillc_runtime.execution.tree.gate import AtLine, AtSkill


@cache
def library() -> SkillLibrary:
    return compile_valid(find_library(SHIPPED / "wiping"))


def places(skill: str) -> list[Position]:
    """Return the places of all calls in the implementations of a skill."""
    implementations = [each for each in library().implementations.values() if each.skill == skill]
    bodies = [each.body.node for each in implementations if isinstance(each.body, Compound)]
    found = sorted(call.source for body in bodies for call in find_calls(body))
    assert found
    return found


def test_a_skill_and_each_line_with_a_call_is_a_breakpoint() -> None:
    assert parse_breakpoints(["Wipe"], library()) == (AtSkill("Wipe"),)
    for place in places("Wipe"):
        at = AtLine(place.path, place.line)
        name = place.path.rpartition("/")[2]
        for written in (place.path, name, f"/some/folder/{place.path}"):
            assert parse_breakpoints([f"{written}:{place.line}"], library()) == (at,)


def test_a_misspelt_skill_is_refused_with_those_that_are_similar() -> None:
    with pytest.raises(RequestError, match=r"there is no skill `Wype` in `wiping`; did you mean `Wipe`"):
        parse_breakpoints(["Wipe", "Wype"], library())


def test_a_line_without_a_call_is_refused_with_the_nearest_that_have_one() -> None:
    place = places("Wipe")[0]
    with pytest.raises(RequestError, match=rf"no call in line 1 of {place.path}; the nearest are in \d+"):
        parse_breakpoints([f"{place.path}:1"], library())


@pytest.mark.parametrize("text", ["none.skill:3", "", "Wipe:x", ":4", "Wipe:" + "9" * 5000])
def test_what_is_neither_is_refused(text: str) -> None:
    with pytest.raises(RequestError, match=r"breakpoint: there (is|are) no"):
        parse_breakpoints([text], library())
