"""What is known of the item of each round in a loop over the individuals of which a condition holds."""

from __future__ import annotations

from skillc_compiler.analysis.exploration import EvalContext, Exploration, explore_sequence
from skillc_compiler.analysis.knowledge.alias_types import same_individual
from skillc_compiler.analysis.knowledge.assume import assume
from skillc_compiler.analysis.knowledge.evaluate import evaluate
from skillc_compiler.analysis.knowledge.state import State
from skillc_compiler.analysis.paths import Path, StatePaths, add_state, havoc_all, widen
from skillc_compiler.program.typed import TypedNode
from skillc_model.conditions import Aggregate, Variable
from skillc_model.rewriting import substitute


def enter(states: StatePaths) -> StatePaths:
    """Return the states in which a round begins, of whose item nothing is known."""
    return states


def enter_with_member(run: Exploration, items: Aggregate, states: StatePaths) -> StatePaths:
    """Return the states in which a round begins, of whose item the condition of the loop holds."""
    found: dict[State, Path] = {}
    for state, path in states.items():
        known = assume(run.types, state, items.where)
        if known is not None:
            add_state(found, known, path)
    return found


def keeps_members(
    run: Exploration, node: TypedNode, items: Aggregate, states: StatePaths, context: EvalContext
) -> bool:
    """Whether each round leaves true what the loop demands of its items, for all items that follow.

    That is so if it is so for one other individual, of which as much is known as of any at the start of a round.
    """
    if run.monitor is not None:
        return False
    name = f"{items.variable} later"
    run.types.classes[name] = items.cls
    of_other = substitute(items.where, {items.variable: Variable(name)})
    starts: dict[State, Path] = {}
    for state in enter_with_member(run, items, havoc_all(run.types, states, run.writes(node))):
        both = assume(run.types, state, of_other)
        if both is not None:
            apart = both.with_facts({same_individual(Variable(items.variable), Variable(name)): False})
            add_state(starts, apart, None)
    run.quiet += 1
    ends = explore_sequence(run, node.children, widen(starts), context)
    run.quiet -= 1
    return all(evaluate(run.types, state, of_other) is True for state in ends.success)
