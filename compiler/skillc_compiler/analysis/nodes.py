"""The states in which a node ends, from those in which it begins: one function for each kind of node."""

from __future__ import annotations

from collections.abc import Iterator
from typing import assert_never

from skillc_compiler.analysis import loops, parallel
from skillc_compiler.analysis.applied import applied_posts, claims
from skillc_compiler.analysis.binding import definite_effects
from skillc_compiler.analysis.calls import explore_call
from skillc_compiler.analysis.decorators import explore_decorator
from skillc_compiler.analysis.exploration import EvalContext, Exploration, explore_sequence, havoc_concurrent
from skillc_compiler.analysis.knowledge.alias_types import AliasTypes, any_individual
from skillc_compiler.analysis.knowledge.apply_effects import apply_effects
from skillc_compiler.analysis.knowledge.assume import assume
from skillc_compiler.analysis.knowledge.havoc import havoc
from skillc_compiler.analysis.knowledge.state import State
from skillc_compiler.analysis.knowledge.writes import OutputWrite, PropertyWrite, RelationWrite, Write
from skillc_compiler.analysis.paths import (
    MAX_STATES,
    EndStates,
    Path,
    StatePaths,
    add_state,
    add_states,
    extend_if_new,
    extend_path,
    widen,
)
from skillc_compiler.analysis.scopes import explore_with
from skillc_compiler.program.typed import TypedNode
from skillc_compiler.program.walk import nodes_in
from skillc_dsl import syntax as s
from skillc_model.conditions import Condition, HasProperty, Holds, Individual, PropertyOf, Variable
from skillc_model.traversal import walk
from skillc_rdf.vocabulary.types import THING

MAX_STEPS = 2_000
"""How often nodes of one body are followed from a state; after that, only their possible writes are considered."""
FACTS_A_STEP = 200
"""A state with so many facts more counts as one step more."""


def explore(run: Exploration, node: TypedNode, states: StatePaths, context: EvalContext) -> EndStates:
    """Return how a node can end from each of these states; from no state, nothing starts.

    Loops and parallel nodes explore their children several times. Results are stored by node, states and context, so
    that nested loops do not take exponential time.
    """
    if not states:
        return EndStates()
    if not run.quiet:
        run.reached.add(id(node))
    if len(states) > MAX_STATES and run.widened_at is None:
        run.widened_at = node.written.span
    states = widen(states) if run.monitor is None else run.monitor.observe(run, widen(states))
    if not (node.children or node.orelse):
        return _explore_kind(run, node, states, context)
    key = (id(node), frozenset(states), context)
    noted, ends = run.known.get(key, (False, None))
    if ends is None or not (noted or run.quiet):
        ends = _explore_kind(run, node, states, context)
        run.known[key] = (not run.quiet, ends)
    return EndStates(dict(ends.success), dict(ends.failure), dict(ends.broken))


def _explore_kind(run: Exploration, node: TypedNode, states: StatePaths, context: EvalContext) -> EndStates:
    run.steps += sum(1 + len(state.facts) // FACTS_A_STEP for state in states)
    if run.steps > MAX_STEPS:
        return _skip(run, node, states, context)
    run.check_reads(node.values, node.conditions, states)
    written = node.written
    match written:
        case s.Block():
            return _explore_block(run, node, written, states, context)
        case s.Decorator():
            return explore_decorator(run, node, written, states, context)
        case s.While() | s.For():
            return loops.explore_loop(run, node, written, states, context)
        case s.Wait() | s.WaitUntil() | s.CheckNode() | s.Fail():
            return _explore_leaf(run, node, states, context)
        case s.If():
            return _explore_if(run, node, written, states, context)
        case s.ApplyPosts():
            return _explore_apply(run, node, written, states, context)
        case s.CallSkill():
            assert node.call is not None, "a call node has a call"
            return explore_call(run, node.call, states, context)
        case s.OnFailure():
            return _explore_on_failure(run, node, states, context)
        case s.Finally():
            return _explore_finally(run, node, states, context)
        case s.With():
            return explore_with(run, node, states, context)
        case _:
            assert_never(written)


def _skip(run: Exploration, node: TypedNode, states: StatePaths, context: EvalContext) -> EndStates:
    """Return the ends of a node that is not explored: any outcome, with everything it may write open."""
    run.widened_at = run.widened_at or node.written.span
    run.reached.update(id(inner) for inner in nodes_in(node))
    left = parallel.states_when_halted(run, node, states, context)
    done = {write.name for write in run.writes(node) if isinstance(write, OutputWrite)}
    assigned: dict[State, Path] = {}
    for state, path in left.items():
        add_state(assigned, state.replace(assigned=state.assigned | done), path)
    return EndStates(assigned, left, dict(left))


def _explore_block(
    run: Exploration, node: TypedNode, written: s.Block, states: StatePaths, context: EvalContext
) -> EndStates:
    match written.kind:
        case "seq":
            return explore_sequence(run, node.children, states, context)
        case "sel":
            return _explore_selector(run, node, states, context)
        case "reactive seq":
            return parallel.explore_reactive_sequence(run, node, states, context)
        case "reactive sel":
            return parallel.explore_reactive_selector(run, node, states, context)
        case "par all" | "par any" | "par race" | "par lead":
            return parallel.explore_parallel(run, node, written.kind, states, context)
        case _:
            assert_never(written.kind)


def _explore_selector(run: Exploration, node: TypedNode, states: StatePaths, context: EvalContext) -> EndStates:
    """Explore a `sel`; if no child succeeds and a hold broke in any of them, the hold is broken."""
    ends, broken = EndStates(), False
    for number, child in enumerate(node.children, 1):
        last = number == len(node.children)
        one = explore(run, child, states, context if last else context.with_failure_caught())
        add_states(ends.success, one.success)
        broken |= bool(one.broken)
        states = one.failed
    ends.failure, ends.broken = dict(states), dict(states) if broken else {}
    return ends


def _explore_on_failure(run: Exploration, node: TypedNode, states: StatePaths, context: EvalContext) -> EndStates:
    """Explore a block, and from where it failed what is done then; a hold that broke counts as broken if that fails."""
    inner = explore(run, node.children[0], states, context.with_failure_caught())
    failed = {
        state: extend_path(path, node.written.span, "it failed, and `on failure` goes on")
        for state, path in inner.failed.items()
    }
    ends = explore_sequence(run, node.orelse, failed, context)
    add_states(ends.success, inner.success)
    if inner.broken:
        ends.broken = {**ends.failure, **ends.broken}
    return ends


def _explore_finally(run: Exploration, node: TypedNode, states: StatePaths, context: EvalContext) -> EndStates:
    """Explore a block, and from each of its ends what is done then, which may fail without a change of the result."""
    inner = explore(run, node.children[0], states, context)

    def go_on(ended: StatePaths) -> dict[State, Path]:
        last = explore_sequence(run, node.orelse, ended, context)
        return {**last.failed, **last.success}

    return EndStates(go_on(inner.success), go_on(inner.failure), go_on(inner.broken))


def _explore_leaf(run: Exploration, node: TypedNode, states: StatePaths, context: EvalContext) -> EndStates:
    ends = EndStates()
    for state, path in states.items():
        match node.written:
            case s.CheckNode(text=text, span=span):
                for holds, ended in ((True, ends.success), (False, ends.failure)):
                    known = assume(run.types, state, node.conditions[0].meaning, holds)
                    if known is not None:
                        add_state(
                            ended,
                            havoc_concurrent(run, known, context),
                            extend_if_new(state, known, path, span, text, holds),
                        )
            case s.Fail(message=message, span=span):
                event = f"it fails: {message.text}"
                add_state(ends.failure, havoc_concurrent(run, state, context), extend_path(path, span, event))
            case s.WaitUntil():
                run.check_holds(state, path, context)
                add_state(
                    ends.success,
                    havoc_concurrent(run, wait_for(run.types, state, node.conditions[0].meaning), context),
                    path,
                )
            case _:
                run.check_holds(state, path, context)
                add_state(ends.success, havoc_concurrent(run, state, context), path)
    return ends


def _explore_if(
    run: Exploration, node: TypedNode, written: s.If, states: StatePaths, context: EvalContext
) -> EndStates:
    ends = EndStates()
    for holds, branch in ((True, node.children), (False, node.orelse)):
        chosen: dict[State, Path] = {}
        for state, path in states.items():
            known = assume(run.types, state, node.conditions[0].meaning, holds)
            if known is not None:
                trail = extend_if_new(state, known, path, node.conditions[0].span, written.text, holds)
                add_state(chosen, havoc_concurrent(run, known, context), trail)
        one = explore_sequence(run, branch, chosen, context)
        add_states(ends.success, one.success)
        ends.add_failures(one)
    return ends


def _explore_apply(
    run: Exploration, node: TypedNode, written: s.ApplyPosts, states: StatePaths, context: EvalContext
) -> EndStates:
    ends = EndStates()
    if run.implementation is None:
        return EndStates(success=dict(states))
    labels = [name.text for name in written.labels]
    posts = [post for post in applied_posts(run.implementation, node) if not post.sensed]
    effects = [effect for _, effect in definite_effects(posts)]
    run.applied.update({effect: (node, post) for post, effect in definite_effects(posts) if claims(effect)})
    for state, path in states.items():
        after = apply_effects(run.types, state, effects)
        event = "`apply` writes " + " and ".join(f"`{label}`" for label in sorted(labels))
        add_state(ends.success, havoc_concurrent(run, after, context), extend_path(path, written.span, event))
    return ends


def wait_for(types: AliasTypes, state: State, condition: Condition) -> State:
    """Return the state once the condition holds; what it reads may have been changed from outside in the meantime."""
    known = assume(types, state, condition)
    if known is not None:
        return known
    changed = havoc(types, state, _writes_from_outside(condition))
    return assume(types, changed, condition) or changed


def _writes_from_outside(condition: Condition) -> Iterator[Write]:
    anything = any_individual(THING)
    for part in walk(condition):
        match part:
            case Holds(subject=subject, relation=relation, object=object_):
                yield RelationWrite(subject, relation, object_, None)
            case HasProperty(subject=of, property=iri):
                yield PropertyWrite(of, iri, None)
            case PropertyOf(of=of, property=iri):
                yield PropertyWrite(of if isinstance(of, Variable | Individual) else anything, iri, None)
