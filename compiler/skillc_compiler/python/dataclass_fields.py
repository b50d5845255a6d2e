"""The constructor that `dataclass` generates."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

import msgspec

from skillc_compiler.python.info import PythonSignature
from skillc_compiler.python.modules import Defined, dotted_name

DATACLASS = "dataclasses.dataclass"


class _Field(msgspec.Struct, frozen=True):
    name: str
    needed: bool
    by_name: bool


def is_dataclass(of: Defined) -> bool:
    """Whether `dataclass` generates the constructor of the class."""
    return any(
        dotted_name(of.module, each) == DATACLASS and not _is_set(each, "init", False) for each in _decorators(of)
    )


def constructor_signature(lineage: Sequence[Defined]) -> PythonSignature:
    """Return the parameters of a dataclass, including the fields of inherited dataclasses."""
    fields: dict[str, _Field] = {}
    for each in reversed(lineage):
        if any(dotted_name(each.module, decorator) == DATACLASS for decorator in _decorators(each)):
            fields |= {field.name: field for field in _fields(each)}
    return PythonSignature(
        by_position=tuple(name for name, field in fields.items() if not field.by_name),
        by_name=tuple(name for name, field in fields.items() if field.by_name),
        needed=tuple(name for name, field in fields.items() if field.needed),
    )


def _fields(of: Defined) -> Iterator[_Field]:
    by_name = any(_is_set(each, "kw_only", True) for each in _decorators(of))
    for part in of.node.body:
        match part:
            case ast.AnnAssign(target=ast.Name(id=name), annotation=annotation, value=value):
                kind = ast.unparse(annotation)
                if kind.split(".")[-1].strip("'\"") == "KW_ONLY":
                    by_name = True
                elif "ClassVar" not in kind and not (value and _is_set(value, "init", False)):
                    alone = by_name or (value is not None and _is_set(value, "kw_only", True))
                    yield _Field(name, not _has_default(value), alone)


def _has_default(value: ast.expr | None) -> bool:
    match value:
        case ast.Call(func=ast.Name(id="field") | ast.Attribute(attr="field"), keywords=keywords):
            return any(each.arg in ("default", "default_factory") for each in keywords)
        case _:
            return value is not None


def _decorators(of: Defined) -> list[ast.expr]:
    return of.node.decorator_list


def _is_set(written: ast.expr, word: str, to: bool) -> bool:
    """Whether a call passes a keyword as true or as false."""
    match written:
        case ast.Call(keywords=keywords):
            constants = {each.arg: each.value.value for each in keywords if isinstance(each.value, ast.Constant)}
            return constants.get(word) is to
        case _:
            return False
