"""Chooses the admissible heuristics of Fast Downward for a task, by the features of the translated task.

LM-cut and pattern databases support neither conditional effects nor axioms, and exit with code 34. Merge-and-shrink
(with label reduction and bisimulation) and h-max support conditional effects; h-max also runs with axioms, but is not
documented to be admissible with them. The blind heuristic is admissible for every task.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

import msgspec


class TaskFeatures(msgspec.Struct, frozen=True):
    """The features of a translated task that not every heuristic supports."""

    conditional_effects: bool
    axioms: bool


class Heuristic(msgspec.Struct, frozen=True):
    """An admissible heuristic in Fast Downward's syntax, and the share of the remaining time for it."""

    text: str
    share: float = 1.0


LM_CUT = Heuristic("lmcut()")
SHORT_LM_CUT = Heuristic("lmcut()", share=0.1)
"""Most tasks are solved at once with LM-cut or not in the whole time."""
PATTERNS = Heuristic("ipdb(max_time=5)", share=0.5)
"""Pattern databases: strong where few variables matter, such as where a robot and some parts are."""
H_MAX = Heuristic("hmax()")
SHORT_H_MAX = Heuristic("hmax()", share=0.1)
"""Many tasks are solved with it while merge-and-shrink would still be computed."""
BLIND = Heuristic("blind()")
MERGE_AND_SHRINK = Heuristic(
    "merge_and_shrink(shrink_strategy=shrink_bisimulation(greedy=false),"
    "merge_strategy=merge_sccs(order_of_sccs=topological,merge_selector=score_based_filtering("
    "scoring_functions=[goal_relevance(),dfp(),total_order()])),"
    "label_reduction=exact(before_shrinking=true,before_merging=false),"
    "max_states=50k,threshold_before_merge=1,main_loop_max_time=60)",
    share=0.5,
)


def read_task_features(task: Path) -> TaskFeatures:
    """Return the features of a task, from the translator's output file; ValueError if that is not a task."""
    conditional = axioms = False
    with task.open(encoding="utf-8") as file:
        lines = iter(file)
        for line in lines:
            word = line.strip()
            if word == "begin_operator" and not conditional:
                conditional = any(count > 0 for count in _count_effect_conditions(lines))
            axioms = axioms or word == "begin_rule"
    return TaskFeatures(conditional, axioms)


def choose_heuristics(features: TaskFeatures) -> tuple[Heuristic, ...]:
    """Return the heuristics that are admissible for such a task, the most promising first."""
    if features.axioms:
        return (BLIND,)
    if features.conditional_effects:
        return (SHORT_H_MAX, MERGE_AND_SHRINK, H_MAX, BLIND)
    return (SHORT_LM_CUT, PATTERNS, LM_CUT, BLIND)


def _count_effect_conditions(lines: Iterable[str]) -> Iterator[int]:
    """Yield the number of conditions of each effect of an operator; the first line is its name."""
    rest = iter(lines)
    next(rest, "")
    for _ in range(int(next(rest, "0"))):
        next(rest, "")
    for _ in range(int(next(rest, "0"))):
        yield int(next(rest, "0").split()[0])
