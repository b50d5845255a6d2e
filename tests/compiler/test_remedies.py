"""What a message recommends was tried, in a bounded number of steps; what was not tried is not called hopeless."""

import pytest
from shipped import shelf, vocabulary

from skillc_compiler.analysis import remedies
from skillc_compiler.analysis.exploration import Exploration
from skillc_compiler.analysis.findings import Remedy
from skillc_compiler.analysis.paths import EndStates
from skillc_compiler.analysis.proof import Prover
from skillc_compiler.analysis.remedies import MOST_STEPS
from skillc_compiler.pipeline import compile
from skillc_compiler.program.typed import Implementation, TypedNode
from skillc_dsl.source import Source

PARTS = 8
HEAD = """use skiros
skill Check {
    in  l: Location
    in  p: Product
    pre l contain p
    noplan
}
impl by_hand of Check { run python "skillc.primitives:StandIn" }
skill Empty {
    in   l: Location
    in   p: Product
    post gone: not l contain p
    noplan
}
impl by_hand of Empty { run python "skillc.primitives:StandIn" }
"""


def helps(parameters: str, steps: str) -> list[str]:
    """Return the help for each precondition that is not guaranteed in a body."""
    body = f"impl by_steps of S {{\n    do seq {{\n{steps}    }}\n}}\n"
    text = f"{HEAD}skill S {{\n    in l: Location\n{parameters}    noplan\n}}\n{body}"
    found = compile([Source("own.skill", text)], vocabulary(), shelf(), "own").diagnostics
    return [each.help for each in found if each.name == "child-precondition"]


@pytest.mark.parametrize(
    ("most", "words"),
    [(MOST_STEPS, "no `pre` is enough, as steps before may change it"), (0, "establish it before, or test it")],
)
def test_only_what_was_tried_is_called_hopeless(most: int, words: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(remedies, "MOST_STEPS", most)
    parameters = "    in p: Product\n    in q: Product\n    in r: [Product]\n"
    [help_] = helps(parameters, "        for each in r { Empty(l, p: each) }\n        Check(l, p)\n")
    assert help_.startswith(words)


def test_a_body_is_explored_again_for_a_bounded_number_of_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    explore, explored = Prover._explore_assuming, list[int]()

    def count(prover: Prover, of: Implementation, body: TypedNode, remedy: Remedy) -> tuple[Exploration, EndStates]:
        run, ends = explore(prover, of, body, remedy)
        explored.append(run.steps)
        return run, ends

    monkeypatch.setattr(Prover, "_explore_assuming", count)
    parameters = "".join(f"    in p{number}: Product\n" for number in range(PARTS))
    steps = "".join(f"        Check(l, p: p{number % PARTS})\n" for number in range(6 * PARTS))
    found = helps(parameters, steps)
    assert len(explored) > 1
    assert sum(explored) <= MOST_STEPS < len(found) * max(explored)
