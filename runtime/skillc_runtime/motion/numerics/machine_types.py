"""Types of machine code: a dataclass is one pointer into the table of its places; its fields are found while compiling.

Numba is needed here.
"""

from __future__ import annotations

from dataclasses import is_dataclass
from itertools import takewhile
from typing import Any, get_args, get_origin

from llvmlite import ir
from numba.core import types
from numba.core.typing.templates import AbstractTemplate, AttributeTemplate, infer_getattr, infer_global
from numba.extending import lower_builtin, lower_getattr_generic, models, register_model
from numba.np.arrayobj import make_array, populate_array

from skillc_runtime.motion.numerics.places import call_entry, count_rows, fields_of

INTEGER, NUMBER = ir.IntType(64), ir.DoubleType()
TABLE = INTEGER.as_pointer()
ROW = 3
"""Integers in a row of a table, to which there are pointers."""


class Memory(types.Type):  # type: ignore[misc]
    """A dataclass whose arrays keep their places in memory."""

    def __init__(self, kind: type) -> None:
        self.kind = kind
        super().__init__(f"Memory({kind.__module__}.{kind.__qualname__})")


@register_model(Memory)
class _MemoryModel(models.PrimitiveModel):  # type: ignore[misc]
    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, TABLE)


def type_of(annotation: Any) -> Any:
    """Return numba's type for an annotation of a parameter or a result."""
    if is_dataclass(annotation):
        assert isinstance(annotation, type)
        return Memory(annotation)
    if annotation in (float, int, bool, None):
        return {float: types.float64, int: types.int64, bool: types.boolean, None: types.void}[annotation]
    if get_origin(annotation) is tuple:
        return types.Tuple([type_of(each) for each in get_args(annotation)])
    dimensions, access = annotation.__metadata__
    kind = types.int64 if access == "integers" else types.float64
    return types.Array(kind, dimensions, *(("A", True) if access == "read" else ("C", False)))


def _type_in_memory(annotation: Any) -> Any:
    found = type_of(annotation)
    return found.copy(layout="C", readonly=False) if isinstance(found, types.Array) else found


@infer_getattr
class _Fields(AttributeTemplate):  # type: ignore[misc]
    key = Memory

    def generic_resolve(self, memory: Any, name: str) -> Any:
        annotation = fields_of(memory.kind).get(name)
        return None if annotation is None else _type_in_memory(annotation)


@lower_getattr_generic(Memory)  # type: ignore[untyped-decorator]
def _read_field(context: Any, builder: Any, memory: Any, table: Any, name: str) -> Any:
    """Return a field: memory begins at its own rows, an array is viewed, a number is read."""
    annotations = fields_of(memory.kind)
    before = sum(count_rows(annotations[each]) for each in takewhile(name.__ne__, annotations))
    row = builder.gep(table, [INTEGER(ROW * before)])
    kind = _type_in_memory(annotations[name])
    if isinstance(kind, Memory):
        return row
    item = context.get_data_type(kind.dtype if isinstance(kind, types.Array) else kind)
    address = builder.inttoptr(_load_constant(builder, row, 0), item.as_pointer())
    if not isinstance(kind, types.Array):
        return builder.load(address)
    shape = [_load_constant(builder, row, 1 + axis) for axis in range(kind.ndim)]
    strides = [INTEGER(8)] if kind.ndim == 1 else [builder.mul(shape[1], INTEGER(8)), INTEGER(8)]
    return view_array(context, builder, kind, address, shape, strides)


def _load_constant(builder: Any, row: Any, column: int) -> Any:
    """Load an integer of a table, which nothing in a compiled function changes."""
    loaded = builder.load(builder.gep(row, [INTEGER(column)]))
    loaded.set_metadata("invariant.load", builder.module.add_metadata([]))
    return loaded


def view_array(context: Any, builder: Any, kind: Any, address: Any, shape: list[Any], strides: list[Any]) -> Any:
    """Return an array of a type that does not own what is at the address."""
    array = make_array(kind)(context, builder)
    populate_array(
        array, data=address, shape=shape, strides=strides, itemsize=INTEGER(8), meminfo=None, parent=None
    )  # fmt: skip
    return array._getvalue()


@infer_global(call_entry)
class _CallEntry(AbstractTemplate):  # type: ignore[misc]
    key = call_entry

    def generic(self, arguments: Any, named: Any) -> Any:
        return types.int64(*arguments)


@lower_builtin(call_entry, types.int64, types.VarArg(types.Any))  # type: ignore[untyped-decorator]
def _call_entry(context: Any, builder: Any, signature: Any, values: Any) -> Any:
    address, *passed = values
    kind = ir.FunctionType(INTEGER, [each.type for each in passed])
    return builder.call(builder.inttoptr(address, kind.as_pointer()), passed)
