"""Emits how a function is called: from Python, with objects as parameters, and from C."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from llvmlite import ir

from skillc_runtime.motion.numerics.machine_code import BOUND, CALL, ENTRY
from skillc_runtime.motion.numerics.machine_types import INTEGER, NUMBER, TABLE, type_of, view_place
from skillc_runtime.motion.numerics.objects import (
    FLOAT64,
    INT64,
    OBJECT,
    RUNTIME_ERROR,
    TYPE_ERROR,
    define_runtime,
    define_take_array,
    raise_error,
)
from skillc_runtime.motion.numerics.places import ROW, count_rows, is_integral, is_on_memory, is_record, list_leaves

BIT, BYTE, SHORT = ir.IntType(1), ir.IntType(8), ir.IntType(32)

IN_C_ORDER, WRITEABLE = 0x1, 0x400
"""Flags of an array of numpy."""


def add_callers(module: Any, part: Any, key: str, annotations: dict[str, Any], returns: Any) -> None:
    """Add the functions to a module that call a compiled part of a program; see `machine_code`."""
    kinds = list(annotations.values())
    on_memory = is_on_memory(kinds)
    made = _Callers(module, part, is_strided=not on_memory)
    made.add_call(key + CALL, kinds)
    if on_memory:
        made.add_call(key + BOUND, [int, *kinds[1:]], on_table=True)
        if all(each in (float, int, bool) for each in kinds[1:]) and returns in (int, bool, None):
            made.add_entry(key + ENTRY, kinds[1:])


class _Callers:
    """Builds functions of a module that call one function."""

    def __init__(self, module: Any, part: Any, is_strided: bool) -> None:
        self._is_strided = is_strided
        self._module, self._context, self._description = module, part.target_context, part.fndesc
        self._function = self._context.declare_function(module, part.fndesc)
        self._take_array = define_take_array(module, self._context, part.fndesc.qualname)
        define_runtime(module)

    def add_call(self, name: str, kinds: Sequence[Any], on_table: bool = False) -> None:
        """Add a function that Python calls; `on_table` if the first parameter is the address of a table."""
        function = ir.Function(self._module, ir.FunctionType(OBJECT, [OBJECT, OBJECT.as_pointer(), INTEGER]), name)
        known, objects, count = function.args
        leaves = sum(1 for kind in kinds for _ in list_leaves("", kind))
        begin, take, run, fail = (function.append_basic_block(each) for each in ("begin", "take", "run", "fail"))
        builder = ir.IRBuilder(begin)
        api = self._context.get_python_api(builder)
        builder.cbranch(builder.icmp_signed("==", count, INTEGER(leaves)), take, fail)
        builder.position_at_end(take)
        taken = iter([builder.load(builder.gep(objects, [INTEGER(number)])) for number in range(leaves)])
        values = [self._take(builder, kind, taken) for kind in kinds]
        if on_table:
            values[0] = builder.inttoptr(values[0], TABLE)
        builder.cbranch(_is_null(builder, api.err_occurred()), run, fail)
        builder.position_at_end(run)
        status, found = self._run(builder, values)
        with builder.if_then(status.is_error):
            raise_error(self._context, builder, known, RUNTIME_ERROR, "a compiled function failed")
            builder.ret(OBJECT(None))
        builder.ret(api.from_native_value(self._description.restype, found))
        builder.position_at_end(fail)
        with builder.if_then(_is_null(builder, api.err_occurred())):
            raise_error(
                self._context, builder, known, TYPE_ERROR, f"{self._description.qualname}: wrong number of arguments"
            )
        builder.ret(OBJECT(None))

    def add_entry(self, name: str, kinds: Sequence[Any]) -> None:
        """Add a function that C calls with the address of a table, which returns an integer; -1 if it failed."""
        passed = [{float: NUMBER, int: INTEGER, bool: BYTE}[each] for each in kinds]
        function = ir.Function(self._module, ir.FunctionType(INTEGER, [TABLE, *passed]), name)
        builder = ir.IRBuilder(function.append_basic_block())
        values = [builder.trunc(each, BIT) if each.type == BYTE else each for each in function.args]
        status, found = self._run(builder, values)
        with builder.if_then(status.is_error):
            builder.ret(INTEGER(-1))
        match found.type:
            case ir.IntType(width=64):
                builder.ret(found)
            case ir.IntType():
                builder.ret(builder.zext(found, INTEGER))
            case _:
                builder.ret(INTEGER(0))

    def _run(self, builder: Any, values: list[Any]) -> Any:
        """Call the function; return its status and its result."""
        described = self._description
        return self._context.call_conv.call_function(
            builder, self._function, described.restype, described.argtypes, values
        )

    def _take(self, builder: Any, kind: Any, objects: Iterator[Any]) -> Any:
        """Return the value of a parameter, of one object or more; an error of Python may be set afterwards."""
        api = self._context.get_python_api(builder)
        if kind is float:
            return api.float_as_double(next(objects))
        if kind is int:
            return api.long_as_longlong(next(objects))
        if kind is bool:
            return builder.icmp_signed("!=", api.object_istrue(next(objects)), SHORT(0))
        if is_record(kind):
            return self._make_table(builder, kind, objects)
        place, array = builder.alloca(INTEGER, ROW), type_of(kind)
        self._place(builder, kind, next(objects), place)
        address, *sizes = (builder.load(builder.gep(place, [INTEGER(each)])) for each in range(ROW))
        return view_place(self._context, builder, array, address, sizes)

    def _make_table(self, builder: Any, kind: Any, objects: Iterator[Any]) -> Any:
        """Return a table of the arrays of a struct, which lasts as long as the call."""
        table = builder.alloca(INTEGER, ROW * count_rows(kind))
        for number, (_, annotation) in enumerate(list_leaves("", kind)):
            row = builder.gep(table, [INTEGER(ROW * number)])
            if annotation is float:
                copy = builder.alloca(NUMBER)
                builder.store(self._take(builder, float, objects), copy)
                builder.store(builder.ptrtoint(copy, INTEGER), row)
            else:
                self._place(builder, annotation, next(objects), row, 0 if self._is_strided else IN_C_ORDER)
        return table

    def _place(self, builder: Any, kind: Any, array: Any, place: Any, flags: int = 0) -> None:
        """Write the place of an array, which has the flags."""
        known = builder.function.args[0]
        if kind.__metadata__[1] != "read":
            flags |= IN_C_ORDER | WRITEABLE
        number = SHORT(INT64 if is_integral(kind) else FLOAT64)
        builder.call(self._take_array, [array, known, SHORT(kind.__metadata__[0]), SHORT(flags), number, place])


def _is_null(builder: Any, pointer: Any) -> Any:
    return builder.icmp_unsigned("==", pointer, pointer.type(None))
