"""The syntax tree of a `.skill` file: exactly what was written, with its places and nothing resolved."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from skillc_dsl.source import Span

# --- names, types, values ---------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Name:
    """A bare (`contain`) or qualified (`skiros:contain`) name."""

    text: str
    span: Span


@dataclass(frozen=True, slots=True)
class ListOf:
    """The type `[T]`."""

    element: TypeName
    span: Span


TypeName: TypeAlias = Name | ListOf


@dataclass(frozen=True, slots=True)
class Quantity:
    """A number with its unit as written: `400 N/m`."""

    value: float
    unit: str
    span: Span


@dataclass(frozen=True, slots=True)
class Number:
    """A bare number; `text` tells `2` from `2.0`."""

    value: float
    text: str
    span: Span


@dataclass(frozen=True, slots=True)
class Text:
    """A string literal, without its quotes."""

    value: str
    span: Span


@dataclass(frozen=True, slots=True)
class Boolean:
    """`true` or `false`."""

    value: bool
    span: Span


@dataclass(frozen=True, slots=True)
class Reference:
    """A name where a value is expected: a parameter, a let, an individual or an enumeration value."""

    name: Name
    span: Span


@dataclass(frozen=True, slots=True)
class Member:
    """`of.property`"""

    of: Value
    property: Name
    span: Span


@dataclass(frozen=True, slots=True)
class Apply:
    """`function(argument, ..)`"""

    function: Name
    arguments: tuple[Value, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class Arithmetic:
    """`left + right` and its like."""

    operator: Literal["+", "-", "*", "/"]
    left: Value
    right: Value
    span: Span


Value: TypeAlias = Quantity | Number | Text | Boolean | Reference | Member | Apply | Arithmetic

# --- conditions -------------------------------------------------------------------------------------------------------

CompareOperator: TypeAlias = Literal["==", "!=", "<", "<=", ">", ">="]


@dataclass(frozen=True, slots=True)
class Anything:
    """`_`: some individual, whichever."""

    span: Span


@dataclass(frozen=True, slots=True)
class Relation:
    """`subject relation object`"""

    subject: Value | Anything
    relation: Name
    object: Value | Anything
    span: Span


@dataclass(frozen=True, slots=True)
class Compare:
    """`left == right` and its like, on property values or on individuals."""

    left: Value
    operator: CompareOperator
    right: Value
    span: Span


@dataclass(frozen=True, slots=True)
class Has:
    """`subject has property`"""

    subject: Value
    property: Name
    span: Span


@dataclass(frozen=True, slots=True)
class Is:
    """`subject is Class`"""

    subject: Value
    cls: Name
    span: Span


@dataclass(frozen=True, slots=True)
class Given:
    """`given parameter`"""

    parameter: Name
    span: Span


@dataclass(frozen=True, slots=True)
class Not:
    """`not body`"""

    body: Condition
    span: Span


@dataclass(frozen=True, slots=True)
class And:
    """`left and right`, flattened."""

    parts: tuple[Condition, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class Or:
    """`left or right`, flattened."""

    parts: tuple[Condition, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class Implies:
    """`if_ implies then`"""

    if_: Condition
    then: Condition
    span: Span


@dataclass(frozen=True, slots=True)
class Quantified:
    """`exists x: Class (body)` or `forall x: Class (body)`."""

    quantifier: Literal["exists", "forall"]
    variable: Name
    cls: Name
    body: Condition
    span: Span


@dataclass(frozen=True, slots=True)
class Bare:
    """A value standing where a condition belongs, such as `surface.isClean`; kept so that a check can explain it."""

    value: Value
    span: Span


Condition: TypeAlias = Relation | Compare | Has | Is | Given | Not | And | Or | Implies | Quantified | Bare

# --- members of skills and implementations ----------------------------------------------------------------------------

Direction: TypeAlias = Literal["in", "opt", "infer", "out"]


@dataclass(frozen=True, slots=True)
class Range:
    """`range low .. high`"""

    low: Value
    high: Value
    span: Span


@dataclass(frozen=True, slots=True)
class Parameter:
    """`in name: Type = default range a .. b`; `any` for `infer any`."""

    direction: Direction
    any: bool
    name: Name
    type: TypeName
    default: Value | None
    range: Range | None
    doc: str
    span: Span


@dataclass(frozen=True, slots=True)
class Refinement:
    """`refine name: Type = default range a .. b`"""

    name: Name
    type: TypeName
    default: Value | None
    range: Range | None
    span: Span


@dataclass(frozen=True, slots=True)
class Requirement:
    """`pre|hold|post [sensed] [label:] condition`; `text` is the condition as written, in one line."""

    kind: Literal["pre", "hold", "post"]
    sensed: bool
    label: Name | None
    condition: Condition
    text: str
    span: Span


@dataclass(frozen=True, slots=True)
class Duration:
    """`duration value`"""

    value: Value
    span: Span


@dataclass(frozen=True, slots=True)
class DeviceUse:
    """`uses parameter` or `shares parameter`."""

    kind: Literal["uses", "shares"]
    parameter: Name
    span: Span


@dataclass(frozen=True, slots=True)
class Flag:
    """`scoped`, `noplan` or `fallback`, alone on its line."""

    flag: Literal["scoped", "noplan", "fallback"]
    span: Span


@dataclass(frozen=True, slots=True)
class Let:
    """`let name = value`"""

    name: Name
    value: Value
    span: Span


@dataclass(frozen=True, slots=True)
class Prefer:
    """`prefer N`"""

    value: Number
    span: Span


@dataclass(frozen=True, slots=True)
class RunPython:
    """`run python "module:Class"`"""

    target: Text
    span: Span


@dataclass(frozen=True, slots=True)
class Body:
    """`do node`"""

    node: Node
    span: Span


@dataclass(frozen=True, slots=True)
class Event:
    """What a `verify` property speaks of: a called skill (a name) or a condition."""

    what: Name | Condition
    span: Span


@dataclass(frozen=True, slots=True)
class Verify:
    """`never A [outside B]`, `A before B` or `after A eventually B`."""

    pattern: Literal["never", "outside", "before", "eventually"]
    first: Event
    second: Event | None
    span: Span


# --- behaviour tree nodes ---------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Block:
    """A node with children and no value of its own."""

    kind: Literal["seq", "sel", "reactive seq", "reactive sel", "par all", "par any", "par race", "par lead",
                  "try", "invert", "once"]
    children: tuple[Node, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class Counted:
    """`retry N { }` or `repeat N { }`."""

    kind: Literal["retry", "repeat"]
    count: Number
    children: tuple[Node, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class Timeout:
    """`timeout Q { }`"""

    limit: Value
    children: tuple[Node, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class Wait:
    """`wait Q`"""

    time: Value
    span: Span


@dataclass(frozen=True, slots=True)
class WaitUntil:
    """`wait until condition`"""

    condition: Condition
    text: str
    span: Span


@dataclass(frozen=True, slots=True)
class If:
    """`if condition { } else { }`; `orelse` is None where there is no `else`."""

    condition: Condition
    text: str
    then: tuple[Node, ...]
    orelse: tuple[Node, ...] | None
    span: Span


@dataclass(frozen=True, slots=True)
class While:
    """`while condition max N { }`"""

    condition: Condition
    text: str
    limit: Number
    children: tuple[Node, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class For:
    """`for variable in items { }`"""

    variable: Name
    items: Value
    children: tuple[Node, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class CheckNode:
    """`check(condition)`"""

    condition: Condition
    text: str
    span: Span


@dataclass(frozen=True, slots=True)
class ApplyPosts:
    """`apply label, ..`"""

    labels: tuple[Name, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class Argument:
    """`name: value` in a call; `name` alone is kept as a reference to the same name."""

    name: Name
    value: Value
    span: Span


@dataclass(frozen=True, slots=True)
class CallSkill:
    """`Skill[implementation](argument, ..) -> out`"""

    skill: Name
    implementation: Name | None
    arguments: tuple[Argument, ...]
    out: Name | None
    span: Span


@dataclass(frozen=True, slots=True)
class With:
    """`with call { }`"""

    call: CallSkill
    children: tuple[Node, ...]
    span: Span


Node: TypeAlias = (
    Block | Counted | Timeout | Wait | WaitUntil | If | While | For | CheckNode | ApplyPosts | CallSkill | With
)

# --- declarations -----------------------------------------------------------------------------------------------------

SkillMember: TypeAlias = Parameter | Requirement | Duration | DeviceUse | Flag
ImplementationMember: TypeAlias = Refinement | Requirement | Duration | Let | Prefer | Body | RunPython | Verify


@dataclass(frozen=True, slots=True)
class Use:
    """`use skiros, rparts`"""

    vocabularies: tuple[Name, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class Prefix:
    """`prefix lab: <iri>`"""

    name: Name
    iri: str
    span: Span


@dataclass(frozen=True, slots=True)
class Import:
    """`import "file.skill"`"""

    path: Text
    span: Span


@dataclass(frozen=True, slots=True)
class ClassDeclaration:
    """`class Name < Parent, .. disjoint Other, ..`"""

    name: Name
    parents: tuple[Name, ...]
    disjoint: tuple[Name, ...]
    doc: str
    span: Span


@dataclass(frozen=True, slots=True)
class Trait:
    """`functional`, `symmetric`, `transitive`, `inverse NAME` or `sub RELATION`."""

    kind: Literal["functional", "symmetric", "transitive", "inverse", "sub"]
    name: Name | None
    span: Span


@dataclass(frozen=True, slots=True)
class RelationDeclaration:
    """`relation name(Domain, Range) traits`; repeated, a further signature."""

    name: Name
    domain: Name
    range: Name
    traits: tuple[Trait, ...]
    doc: str
    span: Span


@dataclass(frozen=True, slots=True)
class PropertyDeclaration:
    """`property name(Domain): Type`"""

    name: Name
    domain: Name
    type: TypeName
    doc: str
    span: Span


@dataclass(frozen=True, slots=True)
class FunctionParameter:
    """`name: Type` in a function's head."""

    name: Name
    type: TypeName
    span: Span


@dataclass(frozen=True, slots=True)
class FunctionDeclaration:
    """`function name(parameter, ..) -> Type = python "module:function"`"""

    name: Name
    parameters: tuple[FunctionParameter, ...]
    result: TypeName
    python: Text
    doc: str
    span: Span


@dataclass(frozen=True, slots=True)
class SkillDeclaration:
    """`skill Name { members }`"""

    name: Name
    members: tuple[SkillMember, ...]
    doc: str
    span: Span


@dataclass(frozen=True, slots=True)
class ImplementationDeclaration:
    """`impl name of Skill { members }`"""

    name: Name
    skill: Name
    members: tuple[ImplementationMember, ...]
    doc: str
    span: Span


@dataclass(frozen=True, slots=True)
class TaskDeclaration:
    """`task name { scene, goal or do }`"""

    name: Name
    scene: Text | None
    goal: Condition | None
    goal_text: str
    body: Body | None
    doc: str
    span: Span


Declaration: TypeAlias = (
    ClassDeclaration
    | RelationDeclaration
    | PropertyDeclaration
    | FunctionDeclaration
    | SkillDeclaration
    | ImplementationDeclaration
    | TaskDeclaration
)


@dataclass(frozen=True, slots=True)
class File:
    """One parsed file. Comments that allow a diagnostic stay in the text; nothing else is lost."""

    path: str
    header: tuple[Use | Prefix | Import, ...]
    declarations: tuple[Declaration, ...]
