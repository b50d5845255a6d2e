"""Before anything moves: whether every skill that a body calls has an implementation whose types fit."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import assert_never

from skillc_compiler.library import tree
from skillc_compiler.library.conditions import Condition, Expression
from skillc_compiler.library.reading import free_variables
from skillc_compiler.library.skills import Compound, Implementation, Primitive, SkillLibrary
from skillc_compiler.library.vocabulary import Position
from skillc_runtime.selection.fit import bind_arguments, bind_defaults
from skillc_runtime.selection.inferred import infer_fixed
from skillc_runtime.selection.python import PrimitiveError, fitting_class
from skillc_runtime.selection.reads import changing_terms, has_fixed_value, is_fixed
from skillc_runtime.selection.select import candidates, why_none
from skillc_runtime.trace.failure import Rejected
from skillc_runtime.world.conditions import evaluate
from skillc_runtime.world.expressions import EvaluationError, value_of
from skillc_runtime.world.state import WorldState
from skillc_runtime.world.values import Value


@dataclass(frozen=True, slots=True)
class Refusal:
    """A call that can never run; `within` are the implementations around it, outermost first."""

    skill: str
    message: str
    source: Position
    within: tuple[str, ...] = ()
    rejected: tuple[Rejected, ...] = ()

    def __str__(self) -> str:
        around = f" (in {' > '.join(self.within)})" if self.within else ""
        return f"{self.source}: {self.message}{around}"


def preflight(body: tree.Node, library: SkillLibrary, state: WorldState) -> tuple[Refusal, ...]:
    """Return why a body cannot run, nothing when it can as far as that is known now.

    Only what no skill changes counts: the classes of individuals, and relations and properties that are no effect
    of any skill. Values that depend on anything else fit everywhere. Alternatives are refused when all are.
    """
    return _Preflight(library, state).node(body, _Known({}, ()))


@dataclass(frozen=True, slots=True)
class _Known:
    """The values that are known in a body, and the implementations around it."""

    values: Mapping[str, Value]
    within: tuple[str, ...]


class _Preflight:
    def __init__(self, library: SkillLibrary, state: WorldState) -> None:
        self._library = library
        self._state = state
        self._changing = changing_terms(library)

    def node(self, node: tree.Node, known: _Known) -> tuple[Refusal, ...]:
        match node:
            case tree.Sequence(children=children) | tree.Parallel(children=children):
                return self._all(children, known)
            case tree.Selector(children=children):
                each = [self.node(child, known) for child in children]
                return tuple(refusal for refusals in each for refusal in refusals) if all(each) else ()
            case tree.With(call=call, child=child):
                return self._all((call, child), known)
            case tree.If():
                return self._branches(node, known)
            case tree.ForEach(variable=variable, child=child):
                unknown = {name: value for name, value in known.values.items() if name != variable}
                return self.node(child, _Known(unknown, known.within))
            case tree.Retry() | tree.Repeat() | tree.Timeout() | tree.Once() | tree.While():
                return self.node(node.child, known)
            case tree.Try() | tree.Invert() | tree.Wait() | tree.WaitUntil() | tree.Check() | tree.Apply():
                return ()
            case tree.Call():
                return self._call(node, known)
            case _:
                assert_never(node)

    def _all(self, nodes: tuple[tree.Node, ...], known: _Known) -> tuple[Refusal, ...]:
        return tuple(refusal for node in nodes for refusal in self.node(node, known))

    def _branches(self, node: tree.If, known: _Known) -> tuple[Refusal, ...]:
        holds = self._truth(node.condition, known.values)
        taken = [node.then] if holds is not False else []
        if node.orelse is not None and holds is not True:
            taken.append(node.orelse)
        return self._all(tuple(taken), known)

    def _call(self, call: tree.Call, known: _Known) -> tuple[Refusal, ...]:
        arguments = self._values(call.arguments, known.values)
        passed = frozenset(call.arguments)
        rejected: list[Rejected] = []
        for implementation in candidates(self._library, call.skill, call.implementation):
            fitting = self._fit(implementation, arguments, passed)
            if isinstance(fitting, Rejected):
                rejected.append(fitting)
            else:
                return self._body(implementation, fitting, known.within)
        message = why_none(call.skill, rejected)
        return (Refusal(call.skill, message, call.source, known.within, tuple(rejected)),)

    def _fit(
        self, implementation: Implementation, arguments: Mapping[str, Value], passed: frozenset[str]
    ) -> dict[str, Value] | Rejected:
        """Return what is known of the parameters, or why the implementation can never take these arguments."""
        bindings: dict[str, Value] = {}
        rejected = bind_arguments(implementation, arguments, passed, self._state, bindings)
        if rejected is not None:
            return rejected
        if isinstance(implementation.body, Primitive):
            try:
                fitting_class(implementation.body.python, implementation.parameters)
            except PrimitiveError as error:
                return Rejected(
                    implementation=implementation.name, stage="start", reason=str(error), source=implementation.source
                )
        bind_defaults(implementation, self._state, bindings, passed)
        fixed = [pre for pre in implementation.pre if is_fixed(pre.condition, self._changing, self._state.vocabulary)]
        return infer_fixed(implementation, tuple(fixed), bindings, passed, self._state)

    def _body(
        self, implementation: Implementation, bindings: dict[str, Value], within: tuple[str, ...]
    ) -> tuple[Refusal, ...]:
        name = f"{implementation.skill}[{implementation.name}]"
        if not isinstance(implementation.body, Compound) or name in within:
            return ()
        lets = {let.name: let.value for let in implementation.lets}
        for let, value in lets.items():
            bindings |= self._values({let: value}, bindings)
        return self.node(implementation.body.node, _Known(bindings, (*within, name)))

    def _values(self, expressions: Mapping[str, Expression], known: Mapping[str, Value]) -> dict[str, Value]:
        """Return those values that are known now and stay as they are."""
        values: dict[str, Value] = {}
        for name, expression in expressions.items():
            fixed = has_fixed_value(expression, self._changing, self._state.vocabulary)
            if fixed and known.keys() >= free_variables(expression):
                try:
                    values[name] = value_of(expression, self._state, known)
                except EvaluationError:
                    continue
        return values

    def _truth(self, condition: Condition, known: Mapping[str, Value]) -> bool | None:
        """Whether the condition holds now and for ever; None when that is not known."""
        if not is_fixed(condition, self._changing, self._state.vocabulary) or not known.keys() >= free_variables(
            condition
        ):
            return None
        return evaluate(condition, self._state, known)
