"""A call: its preconditions looked at, then the states after it by how it ends."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from skillc_compiler.analysis.binding import Binding, bound, candidates, changes, class_of, made_up, required
from skillc_compiler.analysis.forgetting import forgotten
from skillc_compiler.analysis.learning import learned, merged
from skillc_compiler.analysis.run import Around, Effected, Run, disturbed
from skillc_compiler.analysis.state import State
from skillc_compiler.analysis.summaries import hidden, seen_from
from skillc_compiler.analysis.trail import Ends, Trail, Way, Ways, add, step
from skillc_compiler.analysis.truth import things, truth
from skillc_compiler.analysis.writes import Write
from skillc_compiler.analysis.writing import applied
from skillc_compiler.program.typed import Call, Requirement
from skillc_model.conditions import Variable
from skillc_model.reading import free_variables


def called(run: Run, call: Call, ways: Ways, around: Around) -> Ends:
    """Return how a call can end from each of these states."""
    ends = Ends()
    run.read((argument.value for argument in call.arguments), (), ways)
    pre, hold = required(run.program, call, "pre"), required(run.program, call, "hold")
    for state, way in ways.items():
        run.watch_holds(state, way)
        if call.skill is None:
            _after_unknown(call, state, way, ends)
            continue
        state = _aged(run, call, state)
        binding = bound(run.sorts, state, call, pre)
        for name in binding.open_:
            state = state.without(name)
        _look(run, call, binding, (*pre, *hold), state, way, around)
        _end(run, call, binding, (pre, hold), state, way, around, ends)
    return ends


def _aged(run: Run, call: Call, state: State) -> State:
    """Return the state with other names for those that an earlier round of the same call found by itself."""
    assert call.skill is not None, "only calls of known skills find anything"
    known = things(state)
    for parameter in call.skill.parameters:
        name = made_up(call, parameter)
        if name in known:
            former = Variable(f"{name.name}'")
            run.sorts.classes[former.name] = class_of(parameter)
            state = merged(state.without(former.name), name, former)
            state = state.replaced(same={key: thing for key, thing in state.same.items() if key != name.name})
            known = things(state)
    return state


def _after_unknown(call: Call, state: State, way: Way, ends: Ends) -> None:
    done = state.replaced(assigned=state.assigned | {call.out.text}) if call.out else state
    add(ends.success, done, way)
    add(ends.failure, state, way)


def _look(
    run: Run, call: Call, binding: Binding, conditions: Sequence[Requirement], state: State, way: Way, around: Around
) -> None:
    """See what is known of the conditions at the start; one on what the skill finds by itself is open until it runs."""
    for requirement in conditions:
        condition = binding.at_start(requirement.clause.meaning)
        known = truth(run.sorts, state, condition)
        at_run_time = requirement.kind == "hold" or not free_variables(condition).isdisjoint(binding.open_)
        run.tally(call, requirement, known, around.caught or (at_run_time and known is None), way)


def _end(
    run: Run,
    call: Call,
    binding: Binding,
    conditions: tuple[Sequence[Requirement], Sequence[Requirement]],
    state: State,
    way: Way,
    around: Around,
    ends: Ends,
) -> None:
    name, span = binding.skill.name, call.written.span
    succeeded, failed = step(way, span, f"`{name}` succeeds"), step(way, span, f"`{name}` fails")
    started = _started(run, binding, (*conditions[0], *conditions[1]), state)
    after = disturbed(run, _succeeded(run, call, binding, started), around)
    less = disturbed(run, forgotten(run.sorts, state, _of(run, run.summaries.of_call(call, failing=True))), around)
    breaks = run.summaries.may_break(binding.skill)
    for outcome, ended, trail in _watched(run, call, state, (after, less), (succeeded, failed), breaks):
        if outcome == "success" and "endless" in binding.skill.flags:
            continue
        add({"success": ends.success, "failure": ends.failure, "broken": ends.broken}[outcome], ended, trail)


def _watched(
    run: Run, call: Call, before: State, after: tuple[State, State], trails: tuple[Trail, Trail], breaks: bool
) -> Iterator[tuple[str, State, Trail]]:
    """Yield the ends of a call, with what is remembered of it where a property is watched."""
    assert call.skill is not None, "only calls of known skills are watched"
    if run.watch is None:
        yield "success", after[0], trails[0]
        yield "failure", after[1], trails[1]
        if breaks:
            yield "broken", after[1], trails[1]
        return
    name, started = call.skill.name, replace(trails[0], event=f"`{call.skill.name}` starts")
    begun = run.watch.starts(run, before, started, name)
    for outcome, monitors in run.watch.inside(call, before, begun, started).items():
        good = outcome == "success"
        ended, trail = (after[0], trails[0]) if good else (after[1], trails[1])
        for monitor in sorted(monitors):
            told = ended.replaced(monitor=monitor)
            yield outcome, run.watch.succeeds(run, told, name) if good else told, trail


def _started(run: Run, binding: Binding, conditions: Sequence[Requirement], state: State) -> State:
    """The skill runs, so what it needs holds."""
    for requirement in conditions:
        state = learned(run.sorts, state, binding.at_start(requirement.clause.meaning)) or state
    return state


def _succeeded(run: Run, call: Call, binding: Binding, state: State) -> State:
    """The skill succeeded: what it writes is written, and all it promises was seen to hold."""
    hidden_writes = {write for one in candidates(run.program, call) for write in run.leaks(one)}
    if "fallback" in binding.skill.flags:
        hidden_writes |= {w for one in candidates(run.program, call) for w in run.summaries.on_failure(one)}
    state = forgotten(run.sorts, state, _of(run, seen_from(call, frozenset(hidden_writes))))
    if call.out is not None:
        state = state.without(call.out.text)
        _name_output(run, call)
    posts = required(run.program, call, "post")
    had = [Effected(call, post, binding.effect(effect)) for post, effect in changes(posts)]
    run.effects.update({(id(call), id(one.post), one.effect): one for one in had})
    state = applied(run.sorts, state, [one.effect for one in had])
    for post in posts:
        state = learned(run.sorts, state, binding.at_end(post.clause.meaning)) or state
    return state.replaced(assigned=state.assigned | {call.out.text}) if call.out is not None else state


def _name_output(run: Run, call: Call) -> None:
    outputs = [p for p in call.skill.parameters if p.direction == "out"] if call.skill else []
    if outputs and call.out is not None:
        run.sorts.classes[call.out.text] = class_of(outputs[0])


def _of(run: Run, writes: frozenset[Write]) -> frozenset[Write]:
    return hidden(writes, run.stable)
