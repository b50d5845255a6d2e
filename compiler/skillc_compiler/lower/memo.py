"""What the last lowering of a library has made of each declaration, and what planners made of it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from skillc_compiler.program.memo import Latest, Memo, Memos

if TYPE_CHECKING:  # an analysis of an edit may need no planner
    from skillc_model import skills as library
    from skillc_model.pddl.domain import Excluded


@dataclass
class LowerMemo(Memos):
    """The declarations of the last analysis, as lowered, and their names for planners."""

    skills: Memo[library.Skill] = field(default_factory=Memo)
    implementations: Memo[library.Implementation] = field(default_factory=Memo)
    individuals: Memo[frozenset[str]] = field(default_factory=Memo)
    named: Latest[tuple[object, ...]] = field(default_factory=Latest)
    names: Memo[dict[str, str]] = field(default_factory=Memo)


@dataclass
class PlanningMemo(Memos):
    """What planners read of each skill in the last analysis, of all of them, and which they leave out."""

    views: Memo[tuple[object, ...]] = field(default_factory=Memo)
    read: Latest[tuple[object, ...]] = field(default_factory=Latest)
    excluded: Memo[tuple[Excluded, ...]] = field(default_factory=Memo)
