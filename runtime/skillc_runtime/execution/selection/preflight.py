"""Checks before anything moves whether each skill that a body calls has an implementation that can run."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import TypeAlias

import msgspec

from skillc_dsl.descriptions.nodes import DECORATOR_OF
from skillc_dsl.position import Position
from skillc_model import tree
from skillc_model.conditions import Condition, Expression, Not
from skillc_model.read_write import changing_terms, is_fixed
from skillc_model.skills import Declared, Implementation, Primitive, SkillLibrary
from skillc_model.traversal import free_variables
from skillc_runtime.execution.selection.binding import bind_arguments
from skillc_runtime.execution.selection.foresight import ForesightTracker
from skillc_runtime.execution.selection.inferred_parameters import infer_fixed_parameters
from skillc_runtime.execution.selection.python_targets import (
    PrimitiveError,
    import_matching_primitive,
    import_primitive,
)
from skillc_runtime.execution.selection.refusal import Origin, Refusal, join_refusals, track_origin, track_origins
from skillc_runtime.execution.selection.select import explain_none_selected, ranked_implementations
from skillc_runtime.execution.selection.static_values import StaticValues, check_functions, compute_static_values
from skillc_runtime.execution.selection.text_names import UnknownTextName, find_unknown_names
from skillc_runtime.recording.failure import Rejection
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState

ControlNode: TypeAlias = tree.Sequence | tree.Parallel | tree.Selector | tree.Decorator
"""Nodes that only control when their children run."""


def preflight(body: tree.Node, library: SkillLibrary, state: WorldState) -> tuple[Refusal, ...]:
    """Return why a body cannot run; empty if it can, as far as that is known now.

    Only what no skill changes is checked: the classes of individuals, and relations and properties that are not an
    effect of any skill; and arguments of primitives that depend on where things are, as long as nothing before may have
    moved these. Values that depend on anything else are accepted. Alternatives are refused if all are.
    """
    return _Preflight(library, state).check(body, _Scope({}, {}, (), {}))


class _Scope(msgspec.Struct, frozen=True):
    """The known values in a body, the enclosing implementations, and the origins of the values.

    `values` are the same whenever the body runs, `foreseen` are these and those that follow from where things are.
    """

    values: Mapping[str, Value]
    foreseen: Mapping[str, Value]
    within: tuple[str, ...]
    origins: Mapping[str, Origin]


class _Preflight:
    def __init__(self, library: SkillLibrary, state: WorldState) -> None:
        self._library = library
        self._state = state
        self._changing = changing_terms(library)
        self._foresight = ForesightTracker(state)

    def check(self, node: tree.Node, scope: _Scope) -> tuple[Refusal, ...]:
        match node:
            case tree.WaitUntil() | tree.Check():
                return self._check_functions("check", node.condition, node, scope)
            case tree.Wait():
                return self._check_functions("wait", node.seconds, node, scope)
            case tree.Fail() | tree.Apply():
                return ()
            case tree.Call():
                return self._check_call(node, scope)
            case tree.OnFailure(child=child):
                self._foresight.optional(partial(self.check, child, scope))
                return ()
            case tree.Finally(child=child, last=last):
                found = self.check(child, scope)
                self._foresight.optional(partial(self.check, last, scope))
                return found
            case tree.If():
                return self._check_if(node, scope)
            case tree.ForEach():
                return self._check_for_each(node, scope)
            case tree.While():
                inside = self._foresight.optional(partial(self._repeated, node.child, scope))
                return (*self._check_functions("while", node.condition, node, scope), *inside)
            case tree.With(call=call, child=child):
                return self._check_all((call, child), scope)
            case _:
                return self._check_control(node, scope)

    def _check_control(self, node: ControlNode, scope: _Scope) -> tuple[Refusal, ...]:
        """Check a node that only controls when its children run."""
        match node:
            case tree.Sequence(children=children):
                return self._check_all(children, scope)
            case tree.Parallel(children=children, after=after) if after:
                return self._check_all(children, scope)  # each precedes those that wait for it
            case tree.Parallel(children=children):
                return join_refusals(
                    self._foresight.together([partial(self.check, child, scope) for child in children])
                )
            case tree.Selector(children=children):
                each = [self._foresight.optional(partial(self.check, child, scope)) for child in children]
                return join_refusals(each) if all(each) else ()
            case _:
                return self._check_decorator(node, scope)

    def _check_decorator(self, node: tree.Decorator, scope: _Scope) -> tuple[Refusal, ...]:
        row = DECORATOR_OF[tree.kind_of(node)]
        if row.repeats:
            return self._repeated(node.child, scope)
        if row.on_failure == "success":
            self._foresight.optional(partial(self.check, node.child, scope))
            return ()
        return self.check(node.child, scope)

    def _repeated(self, child: tree.Node, scope: _Scope) -> tuple[Refusal, ...]:
        return self._foresight.repeated(partial(self.check, child, scope))

    def _check_all(self, nodes: tuple[tree.Node, ...], scope: _Scope) -> tuple[Refusal, ...]:
        return join_refusals([self.check(node, scope) for node in nodes])

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
        branches = [partial(self.check, branch, scope) for branch in taken]
        if len(branches) == 1 and holds is None:
            unless = node.condition.body if isinstance(node.condition, Not) else None
            inside = [self._foresight.optional(branches[0], unless)]
        else:
            inside = self._foresight.alternatives(branches) if branches else []
        return (*self._check_functions("if", node.condition, node, scope), *join_refusals(inside))

    def _check_for_each(self, node: tree.ForEach, scope: _Scope) -> tuple[Refusal, ...]:
        items = self._compute({node.variable: node.items}, scope.values)
        values, foreseen = (
            {name: value for name, value in known.items() if name != node.variable}
            for known in (scope.values, scope.foreseen)
        )
        unknown = _Scope(values, foreseen, scope.within, scope.origins)
        inside = self._foresight.optional(partial(self._repeated, node.child, unknown))
        return (*self._refuse_undefined("for", items, node.source, scope.within), *inside)

    def _check_call(self, call: tree.Call, scope: _Scope) -> tuple[Refusal, ...]:
        arguments = self._compute(call.arguments, scope.values)
        if arguments.undefined:
            return self._refuse_undefined(call.skill, arguments, call.source, scope.within)
        passed = frozenset(call.arguments)
        foreseen = self._foresight.here.compute(call.arguments, scope.foreseen)
        rejected: list[Rejection] = []
        unknown: dict[Origin, UnknownTextName] = {}
        possible: list[Callable[[], tuple[Refusal, ...]]] = []
        for implementation in ranked_implementations(self._library, call.skill, call.implementation):
            bindings = self._bind(implementation, arguments.values, passed)
            if isinstance(bindings, Rejection):
                rejected.append(bindings)
                continue
            origins = track_origins(call, implementation, scope.origins)
            texts = find_unknown_names(implementation, bindings, self._state, self._changing)
            known = self._foresee_defaults(implementation, {**foreseen, **bindings}, passed)
            problem = self._find_problem(implementation, known)
            if texts:
                unknown |= {origins[name]: text for name, text in texts.items()}
                rejected.append(self._reject_names(implementation, texts))
            elif problem is not None:
                rejected.append(problem)
            else:
                inside = _Scope(bindings, known, scope.within, origins)
                possible.append(partial(self._check_body, implementation, inside))
        if possible:
            return self._foresight.alternatives(possible)[0]
        message = explain_none_selected(call.skill, rejected)
        return (Refusal(call.skill, message, call.source, scope.within, tuple(rejected), unknown),)

    def _foresee_defaults(
        self, implementation: Implementation, known: dict[str, Value], passed: frozenset[str]
    ) -> dict[str, Value]:
        """Return the known values of parameters with those of defaults that follow from where things are."""
        for each in implementation.parameters:
            if each.default is not None and each.name not in known and each.name not in passed:
                known |= self._foresight.here.compute({each.name: each.default}, known)
        return known

    def _find_problem(self, implementation: Implementation, known: Mapping[str, Value]) -> Rejection | None:
        """Return why the primitive of an implementation cannot do what the known arguments say."""
        if not isinstance(implementation.body, Primitive):
            return None
        reason = self._foresight.here.find_problem(import_primitive(implementation.body.python), known)
        if reason is None:
            return None
        return Rejection(implementation=implementation.name, stage="start", reason=reason, source=implementation.source)

    def _reject_names(self, implementation: Implementation, texts: Mapping[str, UnknownTextName]) -> Rejection:
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

    def _check_body(self, implementation: Implementation, scope: _Scope) -> tuple[Refusal, ...]:
        name, here = f"{implementation.skill}[{implementation.name}]", self._foresight.here
        if isinstance(implementation.body, Primitive):
            self._foresight.here = here.after(import_primitive(implementation.body.python), scope.foreseen)
            return ()
        if isinstance(implementation.body, Declared):
            self._foresight.lose()
            return ()
        if name in scope.within:
            self._foresight.lose()
            return ()
        within, refusals = (*scope.within, name), list[Refusal]()
        values, foreseen, origins = dict(scope.values), dict(scope.foreseen), dict(scope.origins)
        for each in implementation.lets:
            let = self._compute({each.name: each.value}, values)
            refusals += self._refuse_undefined(implementation.skill, let, implementation.source, within)
            values |= let.values
            foreseen |= {**here.compute({each.name: each.value}, foreseen), **let.values}
            origins |= track_origin(each.name, each.value, (implementation.source, each.name), origins)
        inside = _Scope(values, foreseen, within, origins)
        return (*refusals, *self.check(implementation.body.node, inside))

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
