"""The states in which decorators end: by what their rows say, or by a rule of their own."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeAlias

from skillc_compiler.analysis.exploration import EvalContext, Exploration, explore_sequence
from skillc_compiler.analysis.loops import explore_repeat, explore_retry
from skillc_compiler.analysis.parallel import states_when_halted
from skillc_compiler.analysis.paths import EndStates, StatePaths, add_state, add_states, extend_path
from skillc_compiler.analysis.summaries import node_key
from skillc_compiler.program.typed import TypedNode
from skillc_dsl import syntax as s


def explore_decorator(
    run: Exploration, node: TypedNode, written: s.Decorator, states: StatePaths, context: EvalContext
) -> EndStates:
    """Return how a decorator can end from each of these states."""
    rule = RULES.get(written.kind)
    return _explore_results(run, node, written, states, context) if rule is None else rule(run, node, states, context)


def _explore_results(
    run: Exploration, node: TypedNode, written: s.Decorator, states: StatePaths, context: EvalContext
) -> EndStates:
    """Explore a decorator that runs its child and changes nothing but its result."""
    row = written.row
    caught = row.on_failure == "success"
    inner = explore_sequence(run, node.children, states, context.with_failure_caught() if caught else context)
    ends = EndStates(broken=inner.broken)
    if caught:
        for state, path in inner.failure.items():
            event = f"the failure is caught by `{written.kind}`"
            add_state(ends.success, state, extend_path(path, written.span, event))
    else:
        add_states(ends.failure, inner.failure)
    if row.on_success == "success":
        add_states(ends.success, inner.success)
    else:
        for state, path in inner.success.items():
            event = f"the success is a failure by `{written.kind}`"
            add_state(ends.failure, state, extend_path(path, written.span, event))
    return ends


def _explore_once(run: Exploration, node: TypedNode, states: StatePaths, context: EvalContext) -> EndStates:
    key, ends = node_key(node), EndStates()
    fresh = {state: path for state, path in states.items() if state.once_results.get(key) is None}
    for state, path in states.items():
        if key in state.once_results:
            for result, ended in ((True, ends.success), (False, ends.failure)):
                if state.once_results[key] in (None, result):
                    add_state(ended, state, path)
    inner = explore_sequence(run, node.children, fresh, context)
    for result, found, ended in (
        (True, inner.success, ends.success),
        (False, inner.failure, ends.failure),
        (False, inner.broken, ends.broken),
    ):
        for state, path in found.items():
            add_state(ended, state.replace(once_results={**state.once_results, key: result}), path)
    return ends


def _explore_timeout(run: Exploration, node: TypedNode, states: StatePaths, context: EvalContext) -> EndStates:
    ends = explore_sequence(run, node.children, states, context)
    for state, path in states_when_halted(run, node, states, context).items():
        add_state(ends.failure, state, extend_path(path, node.written.span, "the time is up"))
    return ends


Rule: TypeAlias = Callable[[Exploration, TypedNode, StatePaths, EvalContext], EndStates]
RULES: Mapping[str, Rule] = {
    "once": _explore_once,
    "retry": explore_retry,
    "repeat": explore_repeat,
    "timeout": _explore_timeout,
}
"""The decorators that do more than change a result."""
