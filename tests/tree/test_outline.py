"""The outline of a body has the nodes that are built for it, with their numbers."""

from __future__ import annotations

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from skillc_runtime.execution.tree.outline import outline_body
from skillc_runtime.execution.tree.run import AttemptInputs, TreeRun
from skillc_runtime.recording.history.node_outcome import NodeOutcome
from tree.library import world
from tree.stage import Stage
from tree.strategies import Play, plays


@given(plays(), st.integers(0, 1000))
@settings(max_examples=50, suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large])
def test_it_numbers_the_nodes_of_a_body_as_a_run_does(play: Play, before: int) -> None:
    run = TreeRun(play.body, play.library, Stage(world(), play.scripts), inputs=AttemptInputs(before))
    outlined = outline_body(play.body, play.library, before)
    assert [(each.id, each.parent, each.kind, each.name, each.source) for each in outlined] == flatten(run.outcome, 0)
    assert outlined[0].id == run.last_node == before + len(outlined)
    assert all((each.call is not None) == (each.kind == "call") for each in outlined)


def flatten(node: NodeOutcome, parent: int) -> list[tuple[object, ...]]:
    below = [each for child in node.children for each in flatten(child, node.id)]
    return [(node.id, parent, node.kind, node.name, node.source), *below]
