"""Follows between which values numbers are, as proofs of `verify` do."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from skillc_compiler.analysis.exploration import Exploration
from skillc_compiler.analysis.knowledge.state import State
from skillc_compiler.analysis.paths import Path, PathStep, StatePaths
from skillc_compiler.program.typed import Call, TypedNode


@dataclass(frozen=True)
class Numbers:
    """Follows nothing but the values of some properties; it is `PropertyMonitor`."""

    properties: frozenset[str]

    def list_numbers(self) -> frozenset[str]:
        return self.properties

    def on_start(self, run: Exploration, state: State, path: PathStep, skill: str) -> State:
        return state

    def on_success(self, run: Exploration, state: State, skill: str) -> State:
        return state

    def after_body(
        self, call: Call, before: State, state: State, path: PathStep
    ) -> Mapping[str, frozenset[tuple[int, bool]]]:
        return {outcome: frozenset({state.monitor}) for outcome in ("success", "failure", "broken")}

    def observe(self, run: Exploration, states: StatePaths) -> dict[State, Path]:
        return dict(states)

    def interleave(self, states: StatePaths, others: tuple[TypedNode, ...]) -> dict[State, Path]:
        return dict(states)
