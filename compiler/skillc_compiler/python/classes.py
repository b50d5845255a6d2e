"""The bases, constructor and methods of a class, read from the source text."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from typing import TypeAlias

from skillc_compiler.python.dataclass_fields import DATACLASS, constructor_signature, is_dataclass
from skillc_compiler.python.info import UNCLEAR, ClassInfo, Method, PythonSignature, Unclear
from skillc_compiler.python.modules import Defined, Function, dotted_name, resolve_expression
from skillc_compiler.python.signatures import inspect_method

Lineage: TypeAlias = "tuple[Defined | Unclear, ...]"
"""A class and its bases, in method resolution order."""

NEUTRAL = frozenset(("object", "typing.Generic", "typing.Protocol", "abc.ABC"))
"""Base classes without a constructor or methods of interest."""
PLAIN_DECORATORS = frozenset((DATACLASS, "typing.final", "typing.runtime_checkable", "functools.total_ordering"))
PLAIN_METACLASSES = frozenset(("abc.ABCMeta", "type"))


def inspect_class(of: Defined) -> ClassInfo:
    """Return what the source text determines about a class."""
    lineage = lineage_of(of)
    known = tuple(each for each in lineage if isinstance(each, Defined))
    unusual = any(_is_decorated(each) or _has_custom_creation(each) for each in known)
    return ClassInfo(
        constructor=None if unusual else _constructor(lineage),
        ancestors=tuple(qualified_name(each) for each in known),
        complete=len(known) == len(lineage) and not any(map(_is_decorated, known)),
        methods=dict(_methods(lineage)),
    )


def lineage_of(of: Defined) -> Lineage:
    """Return a class and its bases, in method resolution order."""
    return _lineage(of, frozenset())


def find_method(of: Defined, name: str) -> Function | None:
    """Return a method that a class defines itself; None if something else may take its place."""
    found = dict(_members(of.node)).get(name)
    return found if isinstance(found, Function) else None


def _lineage(of: Defined, around: frozenset[str]) -> Lineage:
    """Return the class and its bases; if a base is reached twice, the last occurrence counts."""
    found: list[Defined | Unclear] = [of]
    bases = of.node.bases if isinstance(of.node, ast.ClassDef) else []
    for base in bases:
        if dotted_name(of.module, base.value if isinstance(base, ast.Subscript) else base) in NEUTRAL:
            continue
        match resolve_expression(of.module, base):
            case Defined(node=ast.ClassDef()) as parent if qualified_name(parent) not in around:
                found += _lineage(parent, around | {qualified_name(of)})
            case _:
                found.append(UNCLEAR)
    names = [each if isinstance(each, Unclear) else qualified_name(each) for each in found]
    return tuple(each for index, each in enumerate(found) if names[index] not in names[index + 1 :])


def qualified_name(of: Defined) -> str:
    """Return "module:Class"."""
    return f"{of.module.name}:{of.node.name}"


def _is_decorated(of: Defined) -> bool:
    """Whether a decorator may replace the class."""
    return any(dotted_name(of.module, each) not in PLAIN_DECORATORS for each in of.node.decorator_list)


def _has_custom_creation(of: Defined) -> bool:
    """Whether a metaclass or `__new__` may accept other arguments than the constructor."""
    keywords = of.node.keywords if isinstance(of.node, ast.ClassDef) else []
    metaclasses = (each.value for each in keywords if each.arg == "metaclass")
    unusual = any(dotted_name(of.module, each) not in PLAIN_METACLASSES for each in metaclasses)
    return unusual or "__new__" in dict(_members(of.node))


def _members(node: ast.stmt) -> Iterator[tuple[str, ast.stmt]]:
    """Yield the definitions in the body of a class."""
    for part in node.body if isinstance(node, ast.ClassDef) else ():
        match part:
            case ast.FunctionDef(name=name) | ast.AsyncFunctionDef(name=name):
                yield name, part
            case ast.Assign(targets=targets):
                yield from ((target.id, part) for target in targets if isinstance(target, ast.Name))
            case ast.If() | ast.Try() | ast.With():
                yield from ((inner.name, part) for inner in ast.walk(part) if isinstance(inner, Function))
            case _:
                pass


def _methods(lineage: Lineage) -> Iterator[tuple[str, Method | None]]:
    seen: set[str] = set()
    for each in lineage:
        if isinstance(each, Unclear):
            return
        for name, member in dict(_members(each.node)).items():
            if name not in seen:
                found = inspect_method(each.module, member) if isinstance(member, Function) else None
                yield name, Method(qualified_name(each), found) if found else None
            seen.add(name)


def _constructor(lineage: Sequence[Defined | Unclear]) -> PythonSignature | None:
    """Return the parameters of the first constructor among the classes, without `self`; None if not determined."""
    for index, each in enumerate(lineage):
        if isinstance(each, Unclear):
            return None
        match dict(_members(each.node)).get("__init__"):
            case ast.FunctionDef() as function:
                own = inspect_method(each.module, function).signature
                return own and _merge_passed_on(own, function, lineage[index + 1 :])
            case None:
                if is_dataclass(each):
                    return constructor_signature([one for one in lineage[index:] if isinstance(one, Defined)])
            case _:
                return None
    return PythonSignature()


def _merge_passed_on(
    own: PythonSignature, function: ast.FunctionDef, above: Sequence[Defined | Unclear]
) -> PythonSignature:
    """Return the parameters of a constructor; `**rest` that is only passed on becomes those of the next one."""
    rest = function.args.kwarg.arg if function.args.kwarg else ""
    uses = [node for node in ast.walk(function) if isinstance(node, ast.Name) and node.id == rest]
    calls = [node for node in ast.walk(function) if isinstance(node, ast.Call) and _is_super_init(node.func)]
    if len(uses) != 1 or len(calls) != 1 or any(isinstance(each, ast.Starred) for each in calls[0].args):
        return own
    passing = {each.arg: each.value for each in calls[0].keywords}
    next_one = _constructor(above)
    if passing.get(None) is not uses[0] or next_one is None:
        return own
    left = next_one.without_first(len(calls[0].args))
    names = tuple(n for n in (*left.by_position, *left.by_name) if n not in passing and n not in own.by_position)
    return PythonSignature(
        own.by_position,
        own.unnamed,
        tuple(dict.fromkeys((*own.by_name, *names))),
        (*own.needed, *(n for n in left.needed if n in names)),
        own.args,
        left.named,
    )


def _is_super_init(written: ast.expr) -> bool:
    match written:
        case ast.Attribute(value=ast.Call(func=ast.Name(id="super")), attr="__init__"):
            return True
        case _:
            return False
