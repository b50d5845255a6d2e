"""Which implementations a body may run, through any number of calls."""

from __future__ import annotations

from collections.abc import Mapping

from skillc_compiler.program.typed import Implementation, Program, TypedNode
from skillc_compiler.program.walk import calls_in


class CalledBodies:
    """The implementations that the bodies of a program may run."""

    def __init__(self, program: Program) -> None:
        self._known: Mapping[str, tuple[Implementation, ...]] = program.implementations_of
        self._reached: dict[str, frozenset[str] | None] = {}

    def run_by(self, body: TypedNode) -> tuple[Implementation, ...] | None:
        """Return all implementations that a body may run; None if a skill among them may run itself."""
        skills = self._skills_in(body)
        return None if skills is None else tuple(each for name in sorted(skills) for each in self._known.get(name, ()))

    def _skills_in(self, body: TypedNode) -> frozenset[str] | None:
        found = {call.skill.name for call in calls_in(body) if call.skill is not None}
        below = [self._skills_of(name) for name in found]
        return None if None in below else frozenset(found).union(*(each for each in below if each is not None))

    def _skills_of(self, skill: str) -> frozenset[str] | None:
        """Return the skills that the implementations of a skill run; None if one of these may run itself."""
        if skill not in self._reached:
            self._reached[skill] = None  # what is reached again while it is computed runs itself
            below = [
                self._skills_in(each.body) for each in self._known.get(skill, ()) if isinstance(each.body, TypedNode)
            ]
            whole = None if None in below else frozenset[str]().union(*(each for each in below if each is not None))
            self._reached[skill] = whole
        return self._reached[skill]
