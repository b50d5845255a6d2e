"""Follows one `verify` property along all executions of an implementation, also inside the skills that it calls.

A state's `monitor` is what is remembered: a number, 1 once the first event of `before` has happened, or while the
second of `eventually` is still owed; and whether the second event of `outside` is going on. What must not be counts
from its start, what must have been once it has succeeded. An execution that fails owes nothing any more. A condition
is looked at between the nodes of the implementation's own body."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from skillc_compiler.analysis.binding import candidates
from skillc_compiler.analysis.opening import opening
from skillc_compiler.analysis.run import Around, Run
from skillc_compiler.analysis.state import State
from skillc_compiler.analysis.summaries import Summaries, calls_in
from skillc_compiler.analysis.trail import Ends, Trail, Way, Ways, add, length
from skillc_compiler.analysis.truth import truth
from skillc_compiler.program.typed import Call, Event, Implementation, Program, Property, TypedNode

Monitor = tuple[int, bool]


@dataclass
class PropertyWatch:
    """One property of one implementation; `broken` is the shortest way that violates it, `open_` one not decided."""

    property: Property
    program: Program
    summaries: Summaries
    new_run: Callable[[Implementation, TypedNode], Run]
    broken: Trail | None = None
    open_: bool = False
    _inside: dict[tuple[str, Monitor], dict[str, frozenset[Monitor]]] = field(default_factory=dict)
    _depth: int = 0

    def starts(self, run: Run, state: State, way: Trail, skill: str) -> State:
        """Return the state after a skill started; a violation is kept."""
        pattern, (number, inside) = self.property.pattern, state.monitor
        first, second = self.property.first, self.property.second
        if pattern == "never" and first.skill == skill:
            self._violate(way)
        if pattern == "outside" and first.skill == skill and not inside:
            self._outside(run, state, way, second)
        if pattern == "before" and second is not None and second.skill == skill and number == 0:
            self._violate(way)
        if pattern == "outside" and second is not None and second.skill == skill:
            return state.replaced(monitor=(number, True))
        return state

    def succeeds(self, run: Run, state: State, skill: str) -> State:
        """Return the state after a skill succeeded."""
        number, inside = state.monitor
        second = self.property.second
        if self.property.pattern in ("before", "eventually") and self.property.first.skill == skill:
            number = 1
        if self.property.pattern == "eventually" and second is not None and second.skill == skill:
            number = 0
        return state.replaced(monitor=(number, inside))

    def sees(self, run: Run, ways: Ways) -> dict[State, Way]:
        """Return the states with what a condition makes to be remembered; a violation is kept."""
        found: dict[State, Way] = {}
        for state, way in ways.items():
            add(found, self._seen(run, state, way) if self._depth == 0 else state, way)
        return found

    def inside(self, call: Call, before: State, state: State, way: Trail) -> Mapping[str, frozenset[Monitor]]:
        """Return what may be remembered after the body of a call, by how it ends; `before` is the state before it."""
        ended: dict[str, set[Monitor]] = {"success": set(), "failure": {before.monitor}, "broken": set()}
        for one in candidates(self.program, call):
            for outcome, monitors in self._of(one, state.monitor, way).items():
                ended[outcome] |= monitors
        stays = call.skill is not None and "scoped" in call.skill.flags
        lasting = {(number, inside if stays else before.monitor[1]) for number, inside in ended["success"]}
        failed = {kind: {(number, before.monitor[1]) for number, _ in ended[kind]} for kind in ("failure", "broken")}
        return {"success": frozenset(lasting), **{kind: frozenset(found) for kind, found in failed.items()}}

    def beside(self, ways: Ways, others: tuple[TypedNode, ...]) -> dict[State, Way]:
        """Return the states, each also as it is after what others may have done meanwhile."""
        skills = {name for other in others for call in calls_in(other) for name in self.summaries.names(call)}
        found = dict(ways)
        second = self.property.second.skill if self.property.second is not None else None
        for state, way in ways.items():
            if self.property.pattern in ("before", "eventually") and self.property.first.skill in skills:
                add(found, state.replaced(monitor=(1, state.monitor[1])), way)
            if self.property.pattern == "eventually" and second in skills:
                add(found, state.replaced(monitor=(0, state.monitor[1])), way)
        return found

    def ended(self, run: Run, ways: Ways) -> None:
        """The implementation succeeded in these states."""
        for state, way in self.sees(run, ways).items():
            if self.property.pattern == "eventually" and state.monitor[0] == 1 and way is not None:
                self._violate(way)

    def _outside(self, run: Run, state: State, way: Trail, second: Event | None) -> None:
        if second is not None and second.clause is not None:
            known = truth(run.sorts, state, second.clause.meaning) if self._depth == 0 else None
            if known is not False:
                self.open_ |= known is None
                return
        self._violate(way)

    def _seen(self, run: Run, state: State, way: Way) -> State:
        number, inside = state.monitor
        first = self._known(run, state, self.property.first)
        match self.property.pattern:
            case "never" if first and way is not None:
                self._violate(way)
            case "outside" if first and way is not None and not inside:
                self._violate(way)
            case "before" if first:
                number = 1
            case "before" if number == 0 and way is not None and self._known(run, state, self.property.second):
                self._violate(way)
            case "eventually" if self._known(run, state, self.property.second):
                number = 0
            case "eventually" if first:
                number = 1
            case _:
                pass
        return state.replaced(monitor=(number, inside)) if number != state.monitor[0] else state

    def _known(self, run: Run, state: State, event: Event | None) -> bool:
        return event is not None and event.clause is not None and bool(truth(run.sorts, state, event.clause.meaning))

    def _violate(self, way: Trail) -> None:
        if self.broken is None or length(way) < length(self.broken):
            self.broken = way

    def _of(self, implementation: Implementation, monitor: Monitor, way: Trail) -> Mapping[str, frozenset[Monitor]]:
        """Return what may be remembered after a body begun with `monitor`."""
        key = (implementation.key, monitor)
        if key not in self._inside:
            alone = frozenset({monitor})
            self._inside[key] = {"success": alone, "failure": alone, "broken": alone}
            if isinstance(implementation.body, TypedNode):
                self._inside[key] = self._explored(implementation, implementation.body, monitor, way)
        return self._inside[key]

    def _explored(
        self, implementation: Implementation, body: TypedNode, monitor: Monitor, way: Trail
    ) -> dict[str, frozenset[Monitor]]:
        run = self.new_run(implementation, body)
        run.watch = self
        self._depth += 1
        start = opening(run.sorts, implementation).replaced(monitor=monitor)
        ends: Ends = run.explore(run, body, {start: way}, Around())
        self._depth -= 1
        self.open_ |= run.crowded is not None
        return {
            name: frozenset(state.monitor for state in found)
            for name, found in (("success", ends.success), ("failure", ends.failure), ("broken", ends.broken))
        }
