"""Resolving tasks and tests: parameters, a scene, a goal or a body, and what is expected."""

from __future__ import annotations

from collections.abc import Iterator

from msgspec import structs

from skillc_compiler.program.typed import Expectation, Parameter, StartOutcome, Task, Test
from skillc_compiler.program.types import Measure, type_of
from skillc_compiler.program.unknown import UnknownName
from skillc_compiler.resolve.conditions import resolve_condition
from skillc_compiler.resolve.members import resolve_constant
from skillc_compiler.resolve.nodes import resolve_node
from skillc_compiler.resolve.scope import FileContext, LocalName, Scope
from skillc_compiler.resolve.type_names import resolve_type
from skillc_dsl import syntax as s
from skillc_dsl.units import TIME


def resolve_task(context: FileContext, written: s.TaskDeclaration) -> Task:
    """Return the resolved task."""
    kind = "test" if isinstance(written, s.TestDeclaration) else "task"
    scope = Scope(f"the {kind} `{written.name.text}`", skill=f"task {written.name.text}")
    parameters = tuple(_parameters(context, written))
    for parameter, each in zip(written.parameters, parameters, strict=True):
        scope = context.bind(scope, parameter.name, LocalName(each.type, "parameter", each.span))
    goal = resolve_condition(context, scope, written.goal) if written.goal is not None else None
    task = Task(
        name=written.name.text,
        doc=written.doc,
        parameters=parameters,
        scene=written.scene.value if written.scene else None,
        goal=goal,
        goal_text=written.goal_text,
        body=resolve_node(context, scope, written.body.node)[0] if written.body else None,
        backend=written.backend,
        minimise=written.minimise,
        always=tuple(resolve_condition(context, scope, each.condition) for each in written.always),
        within=resolve_constant(context, written.within, Measure(TIME)),
        name_span=written.name.span,
        span=written.span,
    )
    return _with_expectations(context, scope, written, task) if isinstance(written, s.TestDeclaration) else task


def _with_expectations(context: FileContext, scope: Scope, written: s.TestDeclaration, task: Task) -> Test:
    """Return the test whose task is resolved."""
    starts = tuple(resolve_condition(context, scope, each.condition) for each in written.starts)
    expects = tuple(
        Expectation(
            condition=resolve_condition(context, scope, each.condition) if each.condition is not None else None,
            failure=each.failure.value if each.failure is not None else None,
            text=each.text,
            span=each.span,
        )
        for each in written.expects
    )
    outcomes = tuple(_resolve_outcome(context, each) for each in written.outcomes)
    return Test(**structs.asdict(task), starts=starts, outcomes=outcomes, expects=expects)


def _resolve_outcome(context: FileContext, written: s.StartOutcome) -> StartOutcome:
    name = context.names.look_up_skill(written.skill)
    skill = context.skills.get(name) if name else None
    labels = [each.label.text for each in skill.outcomes if each.label] if skill else []
    if skill and written.outcome.text not in labels:
        message = f"the skill `{skill.name}` has no outcome `{written.outcome.text}`"
        otherwise = "" if labels else "only a skill with `outcome` lines can be told what comes of it"
        context.report_unknown(
            UnknownName("outcome", written.outcome, message, tuple(labels), otherwise, owner=skill.name)
        )
    return StartOutcome(skill, written.outcome, written.span)


def _parameters(context: FileContext, written: s.TaskDeclaration) -> Iterator[Parameter]:
    for each in written.parameters:
        declared = resolve_type(context.names, each.type)
        yield Parameter(
            name=each.name.text,
            direction="in",
            any_=False,
            declared=declared,
            type=type_of(declared),
            default=None,
            low=None,
            high=None,
            doc="",
            span=each.name.span,
        )
