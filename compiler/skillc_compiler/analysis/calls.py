"""Calls of skills: their preconditions are checked, then the states after success and failure are computed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from msgspec import structs

from skillc_compiler.analysis.binding import (
    Binding,
    bind_call,
    call_requirements,
    class_of,
    definite_effects,
    fresh_variable,
)
from skillc_compiler.analysis.caller_terms import hide_names, in_caller_terms
from skillc_compiler.analysis.exploration import CallEffect, EvalContext, Exploration, havoc_concurrent
from skillc_compiler.analysis.findings import EarlyApply
from skillc_compiler.analysis.knowledge.apply_effects import apply_effects, is_done, on_known_members, spare
from skillc_compiler.analysis.knowledge.assume import assume, unify
from skillc_compiler.analysis.knowledge.changed_numbers import bounds_of_changed
from skillc_compiler.analysis.knowledge.evaluate import evaluate
from skillc_compiler.analysis.knowledge.havoc import havoc
from skillc_compiler.analysis.knowledge.quantifiers import known_individuals
from skillc_compiler.analysis.knowledge.state import State
from skillc_compiler.analysis.knowledge.writes import Write
from skillc_compiler.analysis.paths import EndStates, Path, PathStep, StatePaths, add_state, extend_path
from skillc_compiler.program.typed import Call, Requirement
from skillc_model.conditions import Effect, ForEach, Variable
from skillc_model.rewriting import substitute
from skillc_model.traversal import free_variables


def explore_call(run: Exploration, call: Call, states: StatePaths, context: EvalContext) -> EndStates:
    """Return how a call can end from each of these states."""
    ends = EndStates()
    run.check_reads((argument.value for argument in call.arguments), (), states)
    is_again = id(call) in run.called
    run.called.add(id(call))
    pre, hold = call_requirements(run.program, call, "pre"), call_requirements(run.program, call, "hold")
    for state, path in states.items():
        run.check_holds(state, path, context)
        run.check_holds_inside(call, state, path)
        if call.skill is None:
            _end_unknown_call(call, state, path, ends)
            continue
        state = _rename_fresh_variables(run, call, state) if is_again else state
        binding = bind_call(run.types, state, call, pre)
        for name in binding.open_ if is_again else ():
            state = state.without_name(name)
        _check_conditions(run, call, binding, (*pre, *hold), state, path, context)
        _end_call(run, call, binding, (pre, hold), state, path, context, ends)
    return ends


def _rename_fresh_variables(run: Exploration, call: Call, state: State) -> State:
    """Return the state with new names for what an earlier round of the same call found at run time."""
    assert call.skill is not None, "only calls of known skills find anything"
    known = known_individuals(state)
    for parameter in call.skill.parameters:
        name = fresh_variable(call, parameter)
        if name in known:
            former = Variable(f"{name.name}'")
            run.types.classes[former.name] = class_of(parameter)
            state = unify(state.without_name(former.name), name, former)
            state = state.replace(aliases={key: thing for key, thing in state.aliases.items() if key != name.name})
            known = known_individuals(state)
    return state


def _end_unknown_call(call: Call, state: State, path: Path, ends: EndStates) -> None:
    done = state.replace(assigned=state.assigned | {call.out.text}) if call.out else state
    add_state(ends.success, done, path)
    add_state(ends.failure, state, path)


def _check_conditions(
    run: Exploration,
    call: Call,
    binding: Binding,
    conditions: Sequence[Requirement],
    state: State,
    path: Path,
    context: EvalContext,
) -> None:
    """Record what is known of the conditions at the start; one on an inferred individual is open until run time."""
    for requirement in conditions:
        condition = binding.at_start(requirement.condition.meaning)
        known = evaluate(run.types, state, condition)
        at_run_time = requirement.kind == "hold" or not free_variables(condition).isdisjoint(binding.open_)
        excused = context.caught or (at_run_time and known is None)
        run.count_precondition(call, requirement, condition, known, excused, path)


def _end_call(
    run: Exploration,
    call: Call,
    binding: Binding,
    conditions: tuple[Sequence[Requirement], Sequence[Requirement]],
    state: State,
    path: Path,
    context: EvalContext,
    ends: EndStates,
) -> None:
    name, span = binding.skill.name, call.written.span
    failed = extend_path(path, span, f"`{name}` fails", failed=True)
    _check_applied(run, call, binding, state, path)
    started = _assume_started(run, binding, (*conditions[0], *conditions[1]), state)
    less = havoc_concurrent(
        run, havoc(run.types, state, _hide_unstable(run, run.summaries.writes_of_call(call, failing=True))), context
    )
    breaks = run.summaries.may_break_hold(binding.skill)
    for label, done in _list_outcomes(run, call, binding, _assume_succeeded(run, call, binding, started)):
        after = havoc_concurrent(run, done, context)
        succeeded = extend_path(path, span, f"`{name}` succeeds" + (f" with `{label}`" if label else ""))
        for outcome, ended, trail in _monitored_ends(run, call, state, (after, less), (succeeded, failed), breaks):
            if outcome == "success" and "endless" in binding.skill.flags:
                continue
            add_state({"success": ends.success, "failure": ends.failure, "broken": ends.broken}[outcome], ended, trail)


def _check_applied(run: Exploration, call: Call, binding: Binding, state: State, path: Path) -> None:
    """Record an `apply` that has written what the call is still to establish."""
    posts = call_requirements(run.program, call, "post") if run.applied and path is not None else ()
    for _, promised in definite_effects(posts):
        effect = binding.effect(promised)
        node, post = run.applied.get(effect, (None, None))
        if node is None or post is None or not any(step.span == node.written.span for step in path or ()):
            continue
        if is_done(run.types, state, effect):
            run.add_finding(("applied", id(node)), EarlyApply(node, post, call=call, path=path), path)


def _monitored_ends(
    run: Exploration,
    call: Call,
    before: State,
    after: tuple[State, State],
    trails: tuple[PathStep, PathStep],
    breaks: bool,
) -> Iterator[tuple[str, State, PathStep]]:
    """Yield the ends of a call as (outcome, state, path), with the state of the monitor if a property is monitored."""
    assert call.skill is not None, "only calls of known skills are watched"
    if run.monitor is None:
        yield "success", after[0], trails[0]
        yield "failure", after[1], trails[1]
        if breaks:
            yield "broken", after[1], trails[1]
        return
    name, started = call.skill.name, structs.replace(trails[0], event=f"`{call.skill.name}` starts")
    begun = run.monitor.on_start(run, before, started, name)
    for outcome, monitors in run.monitor.after_body(call, before, begun, started).items():
        good = outcome == "success"
        ended, trail = (after[0], trails[0]) if good else (after[1], trails[1])
        for monitor in sorted(monitors):
            remembered = ended.replace(monitor=monitor)
            yield outcome, run.monitor.on_success(run, remembered, name) if good else remembered, trail


def _assume_started(run: Exploration, binding: Binding, conditions: Sequence[Requirement], state: State) -> State:
    """Return the state, knowing that the skill runs, so that its pre- and hold conditions hold."""
    for requirement in conditions:
        state = assume(run.types, state, binding.at_start(requirement.condition.meaning)) or state
    return state


def _assume_succeeded(run: Exploration, call: Call, binding: Binding, state: State) -> State:
    """Return the state after the skill succeeded: its writes are applied and its postconditions hold."""
    if call.out is not None:
        state = state.without_name(call.out.text)
        _declare_output(run, call)
    if "fallback" in binding.skill.flags:
        failed = {w for one in run.program.candidates(call) for w in run.summaries.writes_on_failure(one)}
        state = havoc(run.types, state, _hide_unstable(run, in_caller_terms(call, frozenset(failed))))
    before = state
    leaks = frozenset(write for one in run.program.candidates(call) for write in run.leaks(one))
    hidden_writes = _hide_unstable(run, in_caller_terms(call, leaks) | run.summaries.possible_writes_of(call))
    state = havoc(run.types, state, [spare(run.types, before, write) for write in hidden_writes])
    posts = call_requirements(run.program, call, "post")
    effects = [(post, binding.effect(effect)) for post, effect in definite_effects(posts)]
    on_items = [(post, _on_items(run, before, one)) for post, one in effects]
    had = [CallEffect(call, post, each) for post, one in on_items for each in on_known_members(run.types, before, one)]
    run.effects.update({(id(call), id(one.post), one.effect): one for one in had})
    many = {one.effect for one in had if isinstance(one.effect, ForEach)}
    state = apply_effects(run.types, state, [effect for _, effect in effects], before).with_effects(many)
    if run.monitor is not None and (numbers := run.monitor.list_numbers()):
        state = state.with_facts(bounds_of_changed(before, (each for _, each in effects), numbers))
    for post in posts:
        state = assume(run.types, state, binding.at_end(post.condition.meaning)) or state
    return state.replace(assigned=state.assigned | {call.out.text}) if call.out is not None else state


def _list_outcomes(run: Exploration, call: Call, binding: Binding, state: State) -> Iterator[tuple[str, State]]:
    """Yield the label of each outcome that may come of a call that succeeded, and the state in which it has come true.

    What is known is not unlearned: an outcome that contradicts it, or that would change what the skill senses, does not
    come. A skill without outcomes has one state, without a label.
    """
    if not binding.skill.outcomes:
        yield "", state
        return
    sensed = [each.known for each in binding.skill.senses if each.known is not None]
    known = bool(sensed) and all(evaluate(run.types, state, binding.at_end(each)) for each in sensed)
    for outcome in binding.skill.outcomes:
        condition = binding.at_end(outcome.condition.meaning)
        if known and evaluate(run.types, state, condition) is False:
            continue
        effects = [_on_items(run, state, binding.effect(effect)) for _, effect in definite_effects((outcome,))]
        had = [CallEffect(call, outcome, effect) for effect in effects]
        run.effects.update({(id(call), id(one.post), one.effect): one for one in had})
        after = apply_effects(run.types, state, [one.effect for one in had])
        yield outcome.label.text if outcome.label else "", assume(run.types, after, condition) or after


def _on_items(run: Exploration, state: State, effect: Effect) -> Effect:
    """Return an effect on the items for which variables of loops over lists stand."""
    return substitute(effect, {name: state.aliases[name] for name in run.items & state.aliases.keys()})


def _declare_output(run: Exploration, call: Call) -> None:
    outputs = [p for p in call.skill.parameters if p.direction == "out"] if call.skill else []
    if outputs and call.out is not None:
        run.types.classes[call.out.text] = class_of(outputs[0])


def _hide_unstable(run: Exploration, writes: frozenset[Write]) -> frozenset[Write]:
    return hide_names(writes, run.stable)
