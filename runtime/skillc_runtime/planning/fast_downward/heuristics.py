"""Which of Fast Downward's heuristics prove the optimum of a task: its translator's output says what the task needs.

LM-cut takes neither conditional effects nor axioms and ends with code 34. Merge-and-shrink (with label reduction and
bisimulation) and h-max take conditional effects; h-max also runs with axioms, but its documentation promises no lower
bound for them. The blind heuristic is a lower bound for everything.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True, slots=True)
class TaskFeatures:
    """What of a translated task not every heuristic takes."""

    conditional_effects: bool
    axioms: bool


@dataclass(frozen=True, slots=True)
class Heuristic:
    """A lower bound, as Fast Downward writes it; the next one gets a turn once it has had its share of the time."""

    text: str
    share: float = 1.0


LM_CUT = Heuristic("lmcut()")
H_MAX = Heuristic("hmax()")
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
    """Return what a task needs, from the file that the translator wrote; ValueError where that is none."""
    conditional = axioms = False
    with task.open(encoding="utf-8") as file:
        lines = iter(file)
        for line in lines:
            word = line.strip()
            if word == "begin_operator" and not conditional:
                conditional = any(count > 0 for count in _conditions(lines))
            axioms = axioms or word == "begin_rule"
    return TaskFeatures(conditional, axioms)


def choose_heuristics(needs: TaskFeatures) -> tuple[Heuristic, ...]:
    """Return the heuristics that are lower bounds for such a task, the most promising first."""
    if needs.axioms:
        return (BLIND,)
    if needs.conditional_effects:
        return (MERGE_AND_SHRINK, H_MAX, BLIND)
    return (LM_CUT, BLIND)


def _conditions(lines: Iterable[str]) -> Iterator[int]:
    """Yield the number of conditions of each effect of an operator, whose first line is its name."""
    rest = iter(lines)
    next(rest, "")
    for _ in range(int(next(rest, "0"))):
        next(rest, "")
    for _ in range(int(next(rest, "0"))):
        yield int(next(rest, "0").split()[0])
