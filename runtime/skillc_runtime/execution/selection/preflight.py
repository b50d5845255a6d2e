"""Checks before anything moves whether each skill that a body calls has an implementation that can run."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TypeAlias, assert_never

from skillc_model import tree
from skillc_model.conditions import Condition, Expression, Variable
from skillc_model.read_write import changing_terms, is_fixed
from skillc_model.skills import Compound, Implementation, Primitive, SkillLibrary
from skillc_model.traversal import free_variables
from skillc_rdf.vocabulary.types import Position
from skillc_runtime.execution.selection.binding import bind_arguments
from skillc_runtime.execution.selection.inferred_parameters import infer_fixed_parameters
from skillc_runtime.execution.selection.python_targets import PrimitiveError, import_matching_primitive
from skillc_runtime.execution.selection.select import explain_none_selected, ranked_implementations
from skillc_runtime.execution.selection.static_values import StaticValues, check_functions, compute_static_values
from skillc_runtime.execution.selection.text_names import UnknownName, find_unknown_names
from skillc_runtime.recording.failure import Rejection
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState

Origin: TypeAlias = tuple[Position, str]
"""Where a value comes from: the call and name of an argument, or an implementation and its parameter or `let`."""


@dataclass(frozen=True, slots=True)
class Refusal:
    """A call or another node that can never run; `within` are the enclosing implementations, outermost first.

    `unknown_names` are the texts, by origin, for which implementations were rejected that could run otherwise.
    """

    skill: str
    message: str
    source: Position
    within: tuple[str, ...] = ()
    rejected: tuple[Rejection, ...] = ()
    unknown_names: Mapping[Origin, UnknownName] = field(default_factory=dict)

    def __str__(self) -> str:
        within = f" (in {' > '.join(self.within)})" if self.within else ""
        return f"{self.source}: {self.message}{within}"


def preflight(body: tree.Node, library: SkillLibrary, state: WorldState) -> tuple[Refusal, ...]:
    """Return why a body cannot run; empty if it can, as far as that is known now.

    Only what no skill changes is checked: the classes of individuals, and relations and properties that are not an
    effect of any skill. Values that depend on anything else are accepted. Alternatives are refused if all are.
    """
    return _Preflight(library, state).check(body, _Scope({}, (), {}))


@dataclass(frozen=True, slots=True)
class _Scope:
    """The known values in a body, the enclosing implementations, and the origins of the values."""

    values: Mapping[str, Value]
    within: tuple[str, ...]
    origins: Mapping[str, Origin]


class _Preflight:
    def __init__(self, library: SkillLibrary, state: WorldState) -> None:
        self._library = library
        self._state = state
        self._changing = changing_terms(library)

    def check(self, node: tree.Node, scope: _Scope) -> tuple[Refusal, ...]:
        match node:
            case tree.Sequence(children=children) | tree.Parallel(children=children):
                return self._check_all(children, scope)
            case tree.Selector(children=children):
                each = [self.check(child, scope) for child in children]
                return tuple(refusal for refusals in each for refusal in refusals) if all(each) else ()
            case tree.With(call=call, child=child):
                return self._check_all((call, child), scope)
            case tree.If():
                return self._check_if(node, scope)
            case tree.ForEach():
                return self._check_for_each(node, scope)
            case tree.While():
                return (*self._check_functions("while", node.condition, node, scope), *self.check(node.child, scope))
            case tree.Retry() | tree.Repeat() | tree.Timeout() | tree.Once():
                return self.check(node.child, scope)
            case tree.WaitUntil() | tree.Check():
                return self._check_functions("check", node.condition, node, scope)
            case tree.Wait():
                return self._check_functions("wait", node.seconds, node, scope)
            case tree.Try() | tree.Invert() | tree.Apply():
                return ()
            case tree.Call():
                return self._check_call(node, scope)
            case _:
                assert_never(node)

    def _check_all(self, nodes: tuple[tree.Node, ...], scope: _Scope) -> tuple[Refusal, ...]:
        return tuple(refusal for node in nodes for refusal in self.check(node, scope))

    def _check_functions(
        self, name: str, item: Condition | Expression, node: tree.Node, scope: _Scope
    ) -> tuple[Refusal, ...]:
        problem = check_functions(item, self._state)
        return () if problem is None else (Refusal(name, f"{name}: {problem}", node.source, scope.within),)

    def _check_if(self, node: tree.If, scope: _Scope) -> tuple[Refusal, ...]:
        holds = self._evaluate_static(node.condition, scope.values)
        taken = [node.then] if holds is not False else []
        if node.orelse is not None and holds is not True:
            taken.append(node.orelse)
        return (*self._check_functions("if", node.condition, node, scope), *self._check_all(tuple(taken), scope))

    def _check_for_each(self, node: tree.ForEach, scope: _Scope) -> tuple[Refusal, ...]:
        items = self._compute({node.variable: node.items}, scope.values)
        unknown = {name: value for name, value in scope.values.items() if name != node.variable}
        inside = self.check(node.child, _Scope(unknown, scope.within, scope.origins))
        return (*self._refuse_undefined("for", items, node.source, scope.within), *inside)

    def _check_call(self, call: tree.Call, scope: _Scope) -> tuple[Refusal, ...]:
        arguments = self._compute(call.arguments, scope.values)
        if arguments.undefined:
            return self._refuse_undefined(call.skill, arguments, call.source, scope.within)
        passed = frozenset(call.arguments)
        rejected: list[Rejection] = []
        unknown: dict[Origin, UnknownName] = {}
        for implementation in ranked_implementations(self._library, call.skill, call.implementation):
            bindings = self._bind(implementation, arguments.values, passed)
            if isinstance(bindings, Rejection):
                rejected.append(bindings)
                continue
            origins = _track_origins(call, implementation, scope)
            texts = find_unknown_names(implementation, bindings, self._state, self._changing)
            if not texts:
                return self._check_body(implementation, bindings, scope.within, origins)
            unknown |= {origins[name]: text for name, text in texts.items()}
            rejected.append(self._reject_names(implementation, texts))
        message = explain_none_selected(call.skill, rejected)
        return (Refusal(call.skill, message, call.source, scope.within, tuple(rejected), unknown),)

    def _reject_names(self, implementation: Implementation, texts: Mapping[str, UnknownName]) -> Rejection:
        reason = "; ".join(
            f"`{name}` names nothing: {text.message(self._state.vocabulary)}" for name, text in texts.items()
        )
        return Rejection(
            implementation=implementation.name, stage="argument", reason=reason, source=implementation.source
        )

    def _bind(
        self, implementation: Implementation, arguments: Mapping[str, Value], passed: frozenset[str]
    ) -> dict[str, Value] | Rejection:
        """Return the known parameters, or why the implementation can never run with these arguments."""
        bindings: dict[str, Value] = {}
        rejected = bind_arguments(implementation, arguments, passed, self._state, bindings)
        if rejected is not None:
            return rejected
        if isinstance(implementation.body, Primitive):
            try:
                import_matching_primitive(implementation.body.python, implementation.parameters)
            except PrimitiveError as error:
                return Rejection(
                    implementation=implementation.name, stage="start", reason=str(error), source=implementation.source
                )
        rejected = self._bind_defaults(implementation, bindings, passed)
        if rejected is not None:
            return rejected
        fixed = [pre for pre in implementation.pre if is_fixed(pre.condition, self._changing, self._state.vocabulary)]
        inferred = infer_fixed_parameters(implementation, tuple(fixed), bindings, passed, self._state)
        if isinstance(inferred, Rejection):
            return inferred
        return self._bind_defaults(implementation, inferred, passed) or inferred

    def _bind_defaults(
        self, implementation: Implementation, bindings: dict[str, Value], passed: frozenset[str]
    ) -> Rejection | None:
        """Bind the defaults whose values are known; reject the implementation if one is undefined."""
        for parameter in implementation.parameters:
            if parameter.default is None or parameter.name in bindings or parameter.name in passed:
                continue
            default = self._compute({parameter.name: parameter.default}, bindings)
            for name, reason in default.undefined.items():
                reason = f"`{name}` has no value: {reason}"
                return Rejection(
                    implementation=implementation.name, stage="argument", reason=reason, source=parameter.source
                )
            bindings |= default.values
        return None

    def _check_body(
        self,
        implementation: Implementation,
        bindings: dict[str, Value],
        within: tuple[str, ...],
        origins: dict[str, Origin],
    ) -> tuple[Refusal, ...]:
        name = f"{implementation.skill}[{implementation.name}]"
        if not isinstance(implementation.body, Compound) or name in within:
            return ()
        refusals: list[Refusal] = []
        for each in implementation.lets:
            let = self._compute({each.name: each.value}, bindings)
            refusals += self._refuse_undefined(implementation.skill, let, implementation.source, (*within, name))
            bindings |= let.values
            origins |= _track_origin(each.name, each.value, (implementation.source, each.name), origins)
        return (*refusals, *self.check(implementation.body.node, _Scope(bindings, (*within, name), origins)))

    def _compute(self, expressions: Mapping[str, Expression], bound: Mapping[str, Value]) -> StaticValues:
        return compute_static_values(expressions, bound, self._state, self._changing)

    def _refuse_undefined(
        self, what: str, known: StaticValues, source: Position, within: tuple[str, ...]
    ) -> tuple[Refusal, ...]:
        """Return a refusal for each undefined value."""
        return tuple(
            Refusal(what, f"{what}: `{name}` has no value: {reason}", source, within)
            for name, reason in known.undefined.items()
        )

    def _evaluate_static(self, condition: Condition, known: Mapping[str, Value]) -> bool | None:
        """Evaluate a condition that no skill changes; None if a skill may change it or a value is unknown."""
        if not is_fixed(condition, self._changing, self._state.vocabulary) or not known.keys() >= free_variables(
            condition
        ):
            return None
        return evaluate(condition, self._state, known)


def _track_origins(call: tree.Call, implementation: Implementation, scope: _Scope) -> dict[str, Origin]:
    """Return the origin of the value of each parameter."""
    origins: dict[str, Origin] = {each.name: (implementation.source, each.name) for each in implementation.parameters}
    for name, argument in call.arguments.items():
        origins |= _track_origin(name, argument, (call.source, name), scope.origins)
    return origins


def _track_origin(name: str, value: Expression, here: Origin, origins: Mapping[str, Origin]) -> dict[str, Origin]:
    """Return the origin of a named value: `here`, or the origin of the variable that it is."""
    return {name: origins.get(value.name, here) if isinstance(value, Variable) else here}
