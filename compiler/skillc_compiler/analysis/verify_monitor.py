"""Follows one `verify` property along all executions of an implementation, also inside the skills that it calls.

The `monitor` of a state is a number and a flag: the number is 1 once the first event of `before` has happened, or while
the second of `eventually` is still due; the flag is whether the second event of `outside` is going on. Forbidden events
count from their start, required ones once they have succeeded. A failed execution owes nothing. A condition is
evaluated between the nodes of the implementation's own body.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property

from skillc_compiler.analysis.exploration import EvalContext, Exploration
from skillc_compiler.analysis.initial_state import initial_state
from skillc_compiler.analysis.knowledge.canonical import canonical_condition
from skillc_compiler.analysis.knowledge.evaluate import evaluate
from skillc_compiler.analysis.knowledge.state import State
from skillc_compiler.analysis.paths import EndStates, Path, PathStep, StatePaths, add_state, leads_through, path_length
from skillc_compiler.analysis.summaries import WriteSummaries
from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Call, Implementation, Property, TypedNode, VerifyEvent
from skillc_compiler.program.walk import calls_in
from skillc_dsl.source import Span
from skillc_model.conditions import Compare, Variable
from skillc_model.read_write import terms_read

Monitor = tuple[int, bool]


@dataclass
class VerifyMonitor:
    """One property of one implementation; `broken` is the shortest path that violates it, `open_` if undecided.

    `start` is the state in which the body starts. `stuck` are calls that never start: what would come of them is
    reported as that.
    """

    property: Property
    program: Program
    summaries: WriteSummaries
    new_run: Callable[[Implementation, TypedNode], Exploration]
    start: State
    stuck: frozenset[Span] = frozenset()
    broken: PathStep | None = None
    open_: bool = False
    _inside: dict[tuple[str, Monitor], dict[str, frozenset[Monitor]]] = field(default_factory=dict)
    _depth: int = 0

    def list_numbers(self) -> frozenset[str]:
        """Return the properties that its conditions read, as long as these are evaluated."""
        return self._read if self._depth == 0 else frozenset()

    @cached_property
    def _read(self) -> frozenset[str]:
        events = (each for each in (self.property.first, self.property.second) if each is not None)
        conditions = (each.condition.meaning for each in events if each.condition is not None)
        return frozenset(term for each in conditions for term in terms_read(each))

    def on_start(self, run: Exploration, state: State, path: PathStep, skill: str) -> State:
        """Return the state after a skill started; a violation is recorded."""
        pattern, (number, inside) = self.property.pattern, state.monitor
        first, second = self.property.first, self.property.second
        if pattern == "never" and first.skill == skill:
            self._violate(path)
        if pattern == "outside" and first.skill == skill and not inside:
            self._check_outside(run, state, path, second)
        if pattern == "before" and second is not None and second.skill == skill and number == 0:
            self._violate(path)
        if pattern == "outside" and second is not None and second.skill == skill:
            return state.replace(monitor=(number, True))
        return state

    def on_success(self, run: Exploration, state: State, skill: str) -> State:
        """Return the state after a skill succeeded."""
        number, inside = state.monitor
        second = self.property.second
        if self.property.pattern in ("before", "eventually") and self.property.first.skill == skill:
            number = 1
        if self.property.pattern == "eventually" and second is not None and second.skill == skill:
            number = 0
        return state.replace(monitor=(number, inside))

    def observe(self, run: Exploration, states: StatePaths) -> dict[State, Path]:
        """Return the states with conditions evaluated and remembered; a violation is recorded."""
        found: dict[State, Path] = {}
        for state, path in states.items():
            add_state(found, self._observe_state(run, state, path) if self._depth == 0 else state, path)
        return found

    def after_body(self, call: Call, before: State, state: State, path: PathStep) -> Mapping[str, frozenset[Monitor]]:
        """Return the possible memories after the body of a call, by outcome; `before` is the state before it.

        Nothing happens in a skill without implementation, which only a symbolic cell runs.
        """
        ended: dict[str, set[Monitor]] = {"success": set(), "failure": {before.monitor}, "broken": set()}
        if not self.program.candidates(call):
            ended["success"].add(state.monitor)
        for one in self.program.candidates(call):
            for outcome, monitors in self._after_implementation(one, state.monitor, path).items():
                ended[outcome] |= monitors
        stays = call.skill is not None and "scoped" in call.skill.flags
        lasting = {(number, inside if stays else before.monitor[1]) for number, inside in ended["success"]}
        failed = {kind: {(number, before.monitor[1]) for number, _ in ended[kind]} for kind in ("failure", "broken")}
        return {"success": frozenset(lasting), **{kind: frozenset(found) for kind, found in failed.items()}}

    def interleave(self, states: StatePaths, others: tuple[TypedNode, ...]) -> dict[State, Path]:
        """Return the states, each also as it is after what others may have done in parallel."""
        skills = {name for other in others for call in calls_in(other) for name in self.summaries.skills_run_by(call)}
        found = dict(states)
        second = self.property.second.skill if self.property.second is not None else None
        for state, path in states.items():
            if self.property.pattern in ("before", "eventually") and self.property.first.skill in skills:
                add_state(found, state.replace(monitor=(1, state.monitor[1])), path)
            if self.property.pattern == "eventually" and second in skills:
                add_state(found, state.replace(monitor=(0, state.monitor[1])), path)
        return found

    def on_end(self, run: Exploration, states: StatePaths) -> None:
        """Record the violations in these states, in which the implementation succeeded."""
        for state, path in self.observe(run, states).items():
            if self.property.pattern == "eventually" and state.monitor[0] == 1 and path is not None:
                self._violate(path)

    def _check_outside(self, run: Exploration, state: State, path: PathStep, second: VerifyEvent | None) -> None:
        if second is not None and second.condition is not None:
            known = evaluate(run.types, state, second.condition.meaning) if self._depth == 0 else None
            if known is not False:
                self.open_ |= known is None
                return
        self._violate(path)

    def _observe_state(self, run: Exploration, state: State, path: Path) -> State:
        number, inside = state.monitor
        first = self._holds(run, state, self.property.first)
        match self.property.pattern:
            case "never" if first and path is not None:
                self._violate(path)
            case "never" if self._depth == 0 and self._may_be_forbidden(run, state):
                self.open_ = True
            case "outside" if first and path is not None and not inside:
                self._violate(path)
            case "before" if first:
                number = 1
            case "before" if number == 0 and path is not None and self._holds(run, state, self.property.second):
                self._violate(path)
            case "eventually" if self._holds(run, state, self.property.second):
                number = 0
            case "eventually" if first:
                number = 1
            case _:
                pass
        return state.replace(monitor=(number, inside)) if number != state.monitor[0] else state

    def _may_be_forbidden(self, run: Exploration, state: State) -> bool:
        """Whether a value that was set to a parameter, or a number that was changed, is forbidden for some values."""
        event = self.property.first.condition
        asked = canonical_condition(run.types, state, event.meaning) if event is not None else None
        if not isinstance(asked, Compare) or evaluate(run.types, state, asked) is not None:
            return False
        beyond = {"<": ">=", "<=": ">=", ">": "<=", ">=": "<="}.get(asked.operator)
        for fact in state.facts.keys() - self.start.facts.keys():
            if isinstance(fact, Compare) and (fact.left, fact.operator) == (asked.left, beyond):
                return True
        set_to = (
            fact.right
            for fact, true in state.facts.items()
            if true and isinstance(fact, Compare) and (fact.left, fact.operator) == (asked.left, "==")
        )
        names = (value for value in set_to if isinstance(value, Variable) and value.name in run.stable)
        return any(evaluate(run.types, state, Compare(name, asked.operator, asked.right)) is None for name in names)

    def _holds(self, run: Exploration, state: State, event: VerifyEvent | None) -> bool:
        return (
            event is not None
            and event.condition is not None
            and bool(evaluate(run.types, state, event.condition.meaning))
        )

    def _violate(self, path: PathStep) -> None:
        if leads_through(path, self.stuck):
            return
        if self.broken is None or path_length(path) < path_length(self.broken):
            self.broken = path

    def _after_implementation(
        self, implementation: Implementation, monitor: Monitor, path: PathStep
    ) -> Mapping[str, frozenset[Monitor]]:
        """Return the possible memories after a body that began with `monitor`, by outcome."""
        key, alone = (implementation.key, monitor), frozenset({monitor})
        as_before = {"success": alone, "failure": alone, "broken": alone}
        if leads_through(path, self.stuck):
            return as_before
        if key not in self._inside:
            self._inside[key] = as_before
            if isinstance(implementation.body, TypedNode):
                self._inside[key] = self._explore(implementation, implementation.body, monitor, path)
        return self._inside[key]

    def _explore(
        self, implementation: Implementation, body: TypedNode, monitor: Monitor, path: PathStep
    ) -> dict[str, frozenset[Monitor]]:
        run = self.new_run(implementation, body)
        run.monitor = self
        self._depth += 1
        writes = run.summaries.all_writes(implementation)
        start = initial_state(run.types, implementation, writes).replace(monitor=monitor)
        ends: EndStates = run.explore(run, body, {start: path}, EvalContext())
        self._depth -= 1
        self.open_ |= run.widened_at is not None
        return {
            name: frozenset(state.monitor for state in found)
            for name, found in (("success", ends.success), ("failure", ends.failure), ("broken", ends.broken))
        }
