"""Whether a primitive keeps its contract, as far as its text says: what `tick` returns, which outputs it sets."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import TypeAlias

import msgspec

from skillc_compiler.python.class_texts import Use, read_class
from skillc_compiler.python.classes import Lineage, find_method, lineage_of, qualified_name
from skillc_compiler.python.endings import always_raises, own_nodes
from skillc_compiler.python.modules import Defined, Function, Module, dotted_name, resolve_expression
from skillc_compiler.python.signatures import PLAIN_DECORATORS
from skillc_compiler.python.statuses import Reader

PRIMITIVE = "skillc_runtime.primitives.primitive:Primitive"
STAND_IN = "skillc_runtime.primitives.stand_in:StandIn"
NEVER_RETURN = frozenset(
    ("typing.assert_never", "typing_extensions.assert_never", "sys.exit", "os.abort", "exit", "quit")
)


Constant: TypeAlias = bool | int | float | str | None


class Breach(msgspec.Struct, frozen=True):
    """A place in a Python file at which a class does not do what is expected, and what it does; columns from 1."""

    path: str
    line: int
    column: int
    end_column: int
    what: str


class Contract(msgspec.Struct, frozen=True):
    """What the text of a primitive says: what is wrong with its `tick`, and what it sets.

    `outputs` are the names of the outputs that it may set, None if the text does not determine them; `place` is where
    its class begins. `constants` are what outputs are set to where that is written, `outcomes` what may come of it.
    `constructor` is the class that leaves out the constructor of `Primitive`.
    """

    breach: Breach | None = None
    outputs: frozenset[str] | None = None
    place: Breach | None = None
    constants: tuple[tuple[str, Constant, Breach], ...] = ()
    outcomes: tuple[tuple[str, Breach], ...] = ()
    constructor: Breach | None = None


def read_contract(of: Defined) -> Contract:
    """Return what the text of a class determines; nothing of a placeholder or of a class that is no primitive."""
    lineage = lineage_of(of)
    known = [each for each in lineage if isinstance(each, Defined)]
    names = [qualified_name(each) for each in known]
    if len(known) < len(lineage) or PRIMITIVE not in names or STAND_IN in names:
        return Contract()
    own = [each for each, name in zip(known, names, strict=True) if name != PRIMITIVE]
    return Contract(
        _breach_of_tick(own, lineage),
        _outputs(own),
        _breach(of, of.node, ""),
        tuple(_constants(own)),
        tuple(_outcomes(own)),
        _breach_of_constructor(known[: names.index(PRIMITIVE)]),
    )


def _breach_of_tick(own: Sequence[Defined], lineage: Lineage) -> Breach | None:
    for cls in own:
        function = find_method(cls, "tick")
        if function is None:
            continue
        names = (dotted_name(cls.module, each) for each in function.decorator_list)
        if any(each not in PLAIN_DECORATORS - {"abc.abstractmethod"} for each in names):
            return None
        wrong = Reader(cls, function, lineage, partial(_never_returns, cls.module, lineage)).find_wrong()
        return next((_breach(each.of, each.at, each.what) for each in wrong), None)
    return None


def _breach_of_constructor(own: Sequence[Defined]) -> Breach | None:
    """Return where a class before `Primitive` leaves out the constructor of the next one."""
    for cls in own:
        function = find_method(cls, "__init__")
        if function is not None and not any(
            isinstance(node, ast.Attribute) and node.attr == "__init__" for node in own_nodes(function)
        ):
            return _breach(cls, function, "does not call that of `Primitive`")
    return None


def _never_returns(module: Module, lineage: Lineage, call: ast.Call, depth: int = 3) -> bool:
    """Whether a call never returns: it is known for that, or a function or method that always raises."""
    if dotted_name(module, call.func) in NEVER_RETURN or not depth:
        return bool(depth)

    def inner(other: ast.Call) -> bool:
        return _never_returns(module, lineage, other, depth - 1)

    match call.func:
        case ast.Attribute(value=ast.Name(id="self"), attr=name):
            found = (find_method(each, name) for each in lineage if isinstance(each, Defined))
            method = next((each for each in found if each is not None), None)
            return method is not None and always_raises(method, inner)
        case ast.Name() | ast.Attribute():
            target = resolve_expression(module, call.func)
            return (
                isinstance(target, Defined) and isinstance(target.node, Function) and always_raises(target.node, inner)
            )
        case _:
            return False


def _outputs(own: Sequence[Defined]) -> frozenset[str] | None:
    """Return the outputs that classes may set; None if something else may set them."""
    found: set[str] = set()
    for text in map(read_class, (cls.node for cls in own)):
        if text.gives_itself:
            return None
        for use in text.outputs:
            keys = _keys_set(use)
            if keys is None:
                return None
            found |= keys
    return frozenset(found)


def _constants(own: Sequence[Defined]) -> Iterator[tuple[str, Constant, Breach]]:
    """Yield the constants that outputs are set to."""
    for cls, line in _assignments(own):
        match line:
            case ast.Assign(targets=[ast.Subscript(value=ast.Attribute(attr="outputs"), slice=key)], value=value):
                pairs = [(key, value)]
            case ast.Assign(targets=[ast.Attribute(attr="outputs")], value=ast.Dict(keys=keys, values=values)):
                pairs = [(key, value) for key, value in zip(keys, values, strict=True) if key is not None]
            case _:
                continue
        for key, value in pairs:
            match key, value:
                case ast.Constant(value=str() as name), ast.Constant(
                    value=None | bool() | int() | float() | str() as is_
                ):
                    yield name, is_, _breach(cls, line, f"`{ast.unparse(value)}`")


def _outcomes(own: Sequence[Defined]) -> Iterator[tuple[str, Breach]]:
    """Yield the outcomes by which classes may say what has come."""
    for cls, line in _assignments(own):
        match line:
            case ast.Assign(
                targets=[ast.Attribute(value=ast.Name(id="self"), attr="outcome")],
                value=ast.Constant(value=str() as label),
            ) if label:
                yield label, _breach(cls, line, label)


def _assignments(own: Sequence[Defined]) -> Iterator[tuple[Defined, ast.Assign]]:
    return ((cls, node) for cls in own for node in read_class(cls.node).assignments)


def _keys_set(use: Use) -> set[str] | None:
    """Return the keys that one use of `outputs` sets; None if that is not clear."""
    match use.around:
        case ast.Subscript(value=value, slice=ast.Constant(value=str() as key)) if value is use.node:
            return {key}
        case ast.Assign(value=ast.Dict(keys=keys)) if all(isinstance(key, ast.Constant) for key in keys):
            return {str(key.value) for key in keys if isinstance(key, ast.Constant)}
        case ast.Attribute(attr="update"):
            match use.further:
                case ast.Call(args=[], keywords=given) if all(each.arg for each in given):
                    return {each.arg for each in given if each.arg}
                case ast.Call(args=[ast.Dict(keys=keys)], keywords=[]) if all(
                    isinstance(k, ast.Constant) for k in keys
                ):
                    return {str(key.value) for key in keys if isinstance(key, ast.Constant)}
            return None
        case ast.Attribute(attr="get" | "pop" | "keys" | "items" | "values" | "clear") | ast.Compare():
            return set()
        case _:
            return None


def _breach(cls: Defined, node: ast.stmt, what: str) -> Breach:
    """Return what is wrong at a statement, or at its first line if it has several."""
    file, column = cls.module.file, node.col_offset + 1
    single = node.end_lineno == node.lineno and node.end_col_offset is not None
    end = node.end_col_offset + 1 if single and node.end_col_offset is not None else column + 1
    return Breach(str(file) if isinstance(file, Path) else "", node.lineno, column, end, what)
