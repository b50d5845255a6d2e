"""What a step reads of the facts that others write: as few as are enough to keep its conditions as they are.

Of an `exists` that holds, one individual is enough, of an `or`, one part; a `forall` that holds reads of each
individual what keeps the body; of a transitive relation that holds, one chain is enough. As long as these facts stay,
the condition does, whatever else changes.
"""

from __future__ import annotations

from collections import defaultdict, deque
from collections.abc import Collection, Iterable, Sequence

from skillc_model.conditions import And, Condition, Exists, Forall, Holds, Individual, Not, Or, Term, Variable
from skillc_model.read_write import FactPattern, facts_read
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.expressions import Bindings
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.world_state import WorldState

MOST_INDIVIDUALS = 300
"""Of a quantifier over more individuals, all facts that it could read count."""

Reads = frozenset[FactPattern]


class DecidingReads:
    """Finds what conditions read, of what is `written`."""

    def __init__(self, written: Iterable[FactPattern]) -> None:
        self._written: dict[str | None, list[FactPattern]] = defaultdict(list)
        for each in written:
            self._written[each.term].append(each)

    def find(self, condition: Condition, state: WorldState, bindings: Bindings) -> Reads:
        """Return patterns of written facts; while they do not change, the condition has the value that it has now.

        Where that cannot be evaluated, all facts that the condition could read count.
        """
        all_ = self._read_in(condition, state, bindings)
        if not all_:
            return all_
        try:
            return self._decide(condition, state, bindings)
        except EvaluationError:
            return all_

    def _decide(self, condition: Condition, state: WorldState, bindings: Bindings) -> Reads:
        match condition:
            case Not(body):
                return self._decide(body, state, bindings)
            case And(parts) | Or(parts):
                return self._combine([(part, bindings) for part in parts], isinstance(condition, Or), state)
            case Exists(variable, cls, body) | Forall(variable, cls, body):
                members = state.instances(cls)
                if not self._read_in(condition, state, bindings):
                    return frozenset()
                if len(members) > MOST_INDIVIDUALS:
                    return self._read_in(condition, state, bindings)
                each = [(body, {**bindings, variable: individual}) for individual in sorted(members)]
                return self._combine(each, isinstance(condition, Exists), state)
            case Holds(relation=relation) if relation in state.axioms.transitive:
                if (chain := _find_chain(condition, state, bindings)) is None:
                    return self._read_in(condition, state, bindings)
                return frozenset(filter(self._is_written, chain))
            case _:
                return self._read_in(condition, state, bindings)

    def _combine(self, parts: Sequence[tuple[Condition, Bindings]], one_is_enough: bool, state: WorldState) -> Reads:
        """Return the reads of one part that decides, the fewest that there are, or of all parts if none does alone.

        One part decides a disjunction that holds, and a conjunction that does not.
        """
        deciding = [part for part in parts if evaluate(part[0], state, part[1]) == one_is_enough]
        if not deciding:
            return frozenset().union(*(self._decide(*_in(part, state)) for part in parts))
        fewest: Reads | None = None
        for part in deciding:
            reads = self._decide(*_in(part, state))
            if not reads:
                return reads
            if fewest is None or len(reads) < len(fewest):
                fewest = reads
        assert fewest is not None
        return fewest

    def _read_in(self, condition: Condition, state: WorldState, bindings: Bindings) -> Reads:
        named = {name: value for name, value in bindings.items() if isinstance(value, str)}
        return frozenset(each for each in facts_read(condition, named, state.vocabulary) if self._is_written(each))

    def _is_written(self, pattern: FactPattern) -> bool:
        if pattern.term is None:
            return bool(self._written)
        found: Collection[FactPattern] = (*self._written.get(pattern.term, ()), *self._written.get(None, ()))
        return any(pattern.meets(each) for each in found)


def _find_chain(condition: Holds, state: WorldState, bindings: Bindings) -> Reads | None:
    """Return the stated facts of a chain from which a transitive relation of two individuals follows, if it does."""
    start, end = (_individual(each, bindings) for each in (condition.subject, condition.object))
    if start is None or end is None:
        return None
    links = [(each, state.asserted.get(each.relation)) for each in state.axioms.sources[condition.relation]]
    came: dict[str, Reads] = {start: frozenset()}
    waiting = deque([start])
    while waiting:
        here = waiting.popleft()
        for source, index in links:
            if index is None:
                continue
            for other in (index.backward if source.flipped else index.forward).get(here):
                if other not in came:
                    came[other] = came[here] | {FactPattern(source.relation, *source.ends(here, other))}
                    waiting.append(other)
                if other == end:
                    return came[here] | {FactPattern(source.relation, *source.ends(here, other))}
    return None


def _individual(term: Term, bindings: Bindings) -> str | None:
    match term:
        case Individual(iri):
            return iri
        case Variable(name) if isinstance(bindings.get(name), str):
            return str(bindings[name])
        case _:
            return None


def _in(part: tuple[Condition, Bindings], state: WorldState) -> tuple[Condition, WorldState, Bindings]:
    condition, bindings = part
    return condition, state, bindings
