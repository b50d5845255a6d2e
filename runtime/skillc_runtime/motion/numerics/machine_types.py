"""Types of machine code: a struct is one pointer into the table of its places; its fields are found while compiling.

Numba is needed here.
"""

from __future__ import annotations

from itertools import takewhile
from typing import Any, get_args, get_origin

from llvmlite import ir
from numba.core import types
from numba.core.typing.templates import AbstractTemplate, AttributeTemplate, infer_getattr, infer_global
from numba.extending import lower_builtin, lower_getattr_generic, models, register_model
from numba.np.arrayobj import make_array, populate_array

from skillc_runtime.motion.numerics.places import ROW, call_entry, count_rows, fields_of, is_integral, is_record

INTEGER, NUMBER = ir.IntType(64), ir.DoubleType()
TABLE = INTEGER.as_pointer()


class Memory(types.Type):  # type: ignore[misc]
    """A struct as a table of the places of its arrays, which are all in C order unless it is strided."""

    def __init__(self, kind: type, is_strided: bool) -> None:
        self.kind, self.is_strided = kind, is_strided
        super().__init__(f"{'Strided' if is_strided else ''}Memory({kind.__module__}.{kind.__qualname__})")


@register_model(Memory)
class _MemoryModel(models.PrimitiveModel):  # type: ignore[misc]
    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, TABLE)


def type_of(annotation: Any, is_strided: bool = False) -> Any:
    """Return numba's type for an annotation of a parameter or a result; a struct may be strided."""
    if is_record(annotation):
        return Memory(annotation, is_strided)
    if annotation in (float, int, bool, None):
        return {float: types.float64, int: types.int64, bool: types.boolean, None: types.void}[annotation]
    if get_origin(annotation) is tuple:
        return types.Tuple([type_of(each) for each in get_args(annotation)])
    dimensions, access = annotation.__metadata__
    if is_integral(annotation):
        return types.Array(types.int64, dimensions, "C")
    return types.Array(types.float64, dimensions, *(("A", True) if access == "read" else ("C", False)))


def _type_of_field(memory: Memory, name: str) -> Any:
    found = type_of(fields_of(memory.kind)[name], memory.is_strided)
    is_in_order = isinstance(found, types.Array) and not memory.is_strided
    return found.copy(layout="C", readonly=False) if is_in_order else found


@infer_getattr
class _Fields(AttributeTemplate):  # type: ignore[misc]
    key = Memory

    def generic_resolve(self, memory: Any, name: str) -> Any:
        return _type_of_field(memory, name) if name in fields_of(memory.kind) else None


@lower_getattr_generic(Memory)  # type: ignore[untyped-decorator]
def _read_field(context: Any, builder: Any, memory: Any, table: Any, name: str) -> Any:
    """Return a field: memory begins at its own rows, an array is viewed, a number is read."""
    annotations = fields_of(memory.kind)
    before = sum(count_rows(annotations[each]) for each in takewhile(name.__ne__, annotations))
    row = builder.gep(table, [INTEGER(ROW * before)])
    kind = _type_of_field(memory, name)
    if isinstance(kind, Memory):
        return row
    address = _load_constant(builder, row, 0)
    if not isinstance(kind, types.Array):
        return builder.load(builder.inttoptr(address, NUMBER.as_pointer()))
    return view_place(context, builder, kind, address, [_load_constant(builder, row, each) for each in range(1, ROW)])


def _load_constant(builder: Any, row: Any, column: int) -> Any:
    """Load an integer of a table, which nothing in a compiled function changes."""
    loaded = builder.load(builder.gep(row, [INTEGER(column)]))
    loaded.set_metadata("invariant.load", builder.module.add_metadata([]))
    return loaded


def view_place(context: Any, builder: Any, kind: Any, address: Any, sizes: list[Any]) -> Any:
    """Return an array of a type at an address, with the rest of a row of a table."""
    shape, strides = sizes[: kind.ndim], sizes[2 : 2 + kind.ndim]
    if kind.layout == "C":  # known while compiling
        strides = [*([builder.mul(shape[1], INTEGER(8))] if kind.ndim == 2 else []), INTEGER(8)]
    data = builder.inttoptr(address, context.get_data_type(kind.dtype).as_pointer())
    array = make_array(kind)(context, builder)
    populate_array(
        array, data=data, shape=shape, strides=strides, itemsize=INTEGER(8), meminfo=None, parent=None
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
