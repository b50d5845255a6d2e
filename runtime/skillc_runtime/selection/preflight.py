"""Before anything moves: whether every skill that a body calls has an implementation whose types fit."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TypeAlias, assert_never

from skillc_compiler.library import tree
from skillc_compiler.library.conditions import Condition, Expression, Variable
from skillc_compiler.library.reading import free_variables
from skillc_compiler.library.skills import Compound, Implementation, Primitive, SkillLibrary
from skillc_compiler.library.vocabulary import Position
from skillc_runtime.selection.fit import bind_arguments
from skillc_runtime.selection.inferred import infer_fixed
from skillc_runtime.selection.known import Known, known_values, unusable
from skillc_runtime.selection.named import Misnamed, misnamed
from skillc_runtime.selection.python import PrimitiveError, fitting_class
from skillc_runtime.selection.reads import changing_terms, is_fixed
from skillc_runtime.selection.select import candidates, why_none
from skillc_runtime.trace.failure import Rejected
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState

Origin: TypeAlias = tuple[Position, str]
"""Where a value is written: an argument's call and name, or an implementation and its parameter or local name."""


@dataclass(frozen=True, slots=True)
class Refusal:
    """What can never run: a call of a skill or a loop; `within` are the implementations around it, outermost first.

    `misnamed` are the texts, by where they are written, for which implementations that fit otherwise were rejected.
    """

    skill: str
    message: str
    source: Position
    within: tuple[str, ...] = ()
    rejected: tuple[Rejected, ...] = ()
    misnamed: Mapping[Origin, Misnamed] = field(default_factory=dict)

    def __str__(self) -> str:
        around = f" (in {' > '.join(self.within)})" if self.within else ""
        return f"{self.source}: {self.message}{around}"


def preflight(body: tree.Node, library: SkillLibrary, state: WorldState) -> tuple[Refusal, ...]:
    """Return why a body cannot run, nothing when it can as far as that is known now.

    Only what no skill changes counts: the classes of individuals, and relations and properties that are no effect
    of any skill. Values that depend on anything else fit everywhere. Alternatives are refused when all are.
    """
    return _Preflight(library, state).node(body, _Scope({}, (), {}))


@dataclass(frozen=True, slots=True)
class _Scope:
    """The values that are known in a body, the implementations around it, and where the values are written."""

    values: Mapping[str, Value]
    within: tuple[str, ...]
    origins: Mapping[str, Origin]


class _Preflight:
    def __init__(self, library: SkillLibrary, state: WorldState) -> None:
        self._library = library
        self._state = state
        self._changing = changing_terms(library)

    def node(self, node: tree.Node, scope: _Scope) -> tuple[Refusal, ...]:
        match node:
            case tree.Sequence(children=children) | tree.Parallel(children=children):
                return self._all(children, scope)
            case tree.Selector(children=children):
                each = [self.node(child, scope) for child in children]
                return tuple(refusal for refusals in each for refusal in refusals) if all(each) else ()
            case tree.With(call=call, child=child):
                return self._all((call, child), scope)
            case tree.If():
                return self._branches(node, scope)
            case tree.ForEach():
                return self._each(node, scope)
            case tree.While():
                return (*self._evaluated("while", node.condition, node, scope), *self.node(node.child, scope))
            case tree.Retry() | tree.Repeat() | tree.Timeout() | tree.Once():
                return self.node(node.child, scope)
            case tree.WaitUntil() | tree.Check():
                return self._evaluated("check", node.condition, node, scope)
            case tree.Wait():
                return self._evaluated("wait", node.seconds, node, scope)
            case tree.Try() | tree.Invert() | tree.Apply():
                return ()
            case tree.Call():
                return self._call(node, scope)
            case _:
                assert_never(node)

    def _all(self, nodes: tuple[tree.Node, ...], scope: _Scope) -> tuple[Refusal, ...]:
        return tuple(refusal for node in nodes for refusal in self.node(node, scope))

    def _evaluated(
        self, name: str, item: Condition | Expression, node: tree.Node, scope: _Scope
    ) -> tuple[Refusal, ...]:
        broken = unusable(item, self._state)
        return () if broken is None else (Refusal(name, f"{name}: {broken}", node.source, scope.within),)

    def _branches(self, node: tree.If, scope: _Scope) -> tuple[Refusal, ...]:
        holds = self._truth(node.condition, scope.values)
        taken = [node.then] if holds is not False else []
        if node.orelse is not None and holds is not True:
            taken.append(node.orelse)
        return (*self._evaluated("if", node.condition, node, scope), *self._all(tuple(taken), scope))

    def _each(self, node: tree.ForEach, scope: _Scope) -> tuple[Refusal, ...]:
        items = self._compute({node.variable: node.items}, scope.values)
        unknown = {name: value for name, value in scope.values.items() if name != node.variable}
        inside = self.node(node.child, _Scope(unknown, scope.within, scope.origins))
        return (*self._never("for", items, node.source, scope.within), *inside)

    def _call(self, call: tree.Call, scope: _Scope) -> tuple[Refusal, ...]:
        arguments = self._compute(call.arguments, scope.values)
        if arguments.never:
            return self._never(call.skill, arguments, call.source, scope.within)
        passed = frozenset(call.arguments)
        rejected: list[Rejected] = []
        wrong: dict[Origin, Misnamed] = {}
        for implementation in candidates(self._library, call.skill, call.implementation):
            fitting = self._fit(implementation, arguments.values, passed)
            if isinstance(fitting, Rejected):
                rejected.append(fitting)
                continue
            origins = _origins(call, implementation, scope)
            texts = misnamed(implementation, fitting, self._state, self._changing)
            if not texts:
                return self._body(implementation, fitting, scope.within, origins)
            wrong |= {origins[name]: text for name, text in texts.items()}
            rejected.append(self._no_names(implementation, texts))
        message = why_none(call.skill, rejected)
        return (Refusal(call.skill, message, call.source, scope.within, tuple(rejected), wrong),)

    def _no_names(self, implementation: Implementation, texts: Mapping[str, Misnamed]) -> Rejected:
        reason = "; ".join(
            f"`{name}` names nothing: {text.message(self._state.vocabulary)}" for name, text in texts.items()
        )
        return Rejected(
            implementation=implementation.name, stage="argument", reason=reason, source=implementation.source
        )

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
        rejected = self._bind_defaults(implementation, bindings, passed)
        if rejected is not None:
            return rejected
        fixed = [pre for pre in implementation.pre if is_fixed(pre.condition, self._changing, self._state.vocabulary)]
        inferred = infer_fixed(implementation, tuple(fixed), bindings, passed, self._state)
        if isinstance(inferred, Rejected):
            return inferred
        return self._bind_defaults(implementation, inferred, passed) or inferred

    def _bind_defaults(
        self, implementation: Implementation, bindings: dict[str, Value], passed: frozenset[str]
    ) -> Rejected | None:
        """Bind the defaults whose values are known; reject one that can never be had."""
        for parameter in implementation.parameters:
            if parameter.default is None or parameter.name in bindings or parameter.name in passed:
                continue
            default = self._compute({parameter.name: parameter.default}, bindings)
            for name, reason in default.never.items():
                reason = f"`{name}` cannot be had: {reason}"
                return Rejected(
                    implementation=implementation.name, stage="argument", reason=reason, source=parameter.source
                )
            bindings |= default.values
        return None

    def _body(
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
            refusals += self._never(implementation.skill, let, implementation.source, (*within, name))
            bindings |= let.values
            origins |= _written(each.name, each.value, (implementation.source, each.name), origins)
        return (*refusals, *self.node(implementation.body.node, _Scope(bindings, (*within, name), origins)))

    def _compute(self, expressions: Mapping[str, Expression], bound: Mapping[str, Value]) -> Known:
        return known_values(expressions, bound, self._state, self._changing)

    def _never(self, what: str, known: Known, source: Position, within: tuple[str, ...]) -> tuple[Refusal, ...]:
        """Return a refusal for each value that can never be had."""
        return tuple(
            Refusal(what, f"{what}: `{name}` cannot be had: {reason}", source, within)
            for name, reason in known.never.items()
        )

    def _truth(self, condition: Condition, known: Mapping[str, Value]) -> bool | None:
        """Whether the condition holds now and for ever; None when that is not known."""
        if not is_fixed(condition, self._changing, self._state.vocabulary) or not known.keys() >= free_variables(
            condition
        ):
            return None
        return evaluate(condition, self._state, known)


def _origins(call: tree.Call, implementation: Implementation, scope: _Scope) -> dict[str, Origin]:
    """Return where the value of each parameter is written."""
    origins: dict[str, Origin] = {each.name: (implementation.source, each.name) for each in implementation.parameters}
    for name, argument in call.arguments.items():
        origins |= _written(name, argument, (call.source, name), scope.origins)
    return origins


def _written(name: str, value: Expression, here: Origin, origins: Mapping[str, Origin]) -> dict[str, Origin]:
    """Return where a value with a name is written: here, or where the variable that it is has its value from."""
    return {name: origins.get(value.name, here) if isinstance(value, Variable) else here}
