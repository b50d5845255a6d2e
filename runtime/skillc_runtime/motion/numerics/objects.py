"""Emits what compiled functions need to run without numba: they take arrays from Python, allocate and reshape."""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba.core.cgutils import get_or_insert_function

from skillc_runtime.motion.arrays import np

BYTE, SHORT, INTEGER = ir.IntType(8), ir.IntType(32), ir.IntType(64)
OBJECT = BYTE.as_pointer()

DATA, AXES, SHAPE, STRIDES, TYPE, FLAGS = 16, 24, 32, 40, 56, 64
"""Offsets in numpy's `PyArrayObject_fields`, which its binary interface fixes."""

ORDER, NUMBER = 26, 28
"""Offsets in numpy's `PyArray_Descr`."""

SWAPPED, FLOAT64 = ord(">"), np.dtype(np.float64).num
INT64 = np.dtype(np.int64).num
"""What descriptions of types have at these offsets."""

BLOCK, ALIGNMENT = 64, 64
"""Bytes before allocated data, for a `NRT_MemInfo` of numba: count of references, destructor and its argument, data."""


ARRAY_TYPE, TYPE_ERROR, RUNTIME_ERROR = range(3)
"""Items of `machine_code.KNOWN`."""


def get_known(builder: Any, known: Any, number: int) -> Any:
    """Return one of the objects that a function called from Python gets as itself."""
    takes = ir.FunctionType(OBJECT, [OBJECT, INTEGER])
    return builder.call(get_or_insert_function(builder.module, takes, "PyTuple_GetItem"), [known, INTEGER(number)])


def raise_error(context: Any, builder: Any, known: Any, number: int, text: str) -> None:
    """Set an error of Python."""
    context.get_python_api(builder).err_set_string(get_known(builder, known, number), text)


def define_take_array(module: Any, context: Any, function_name: str) -> Any:
    """Define and return a function that writes where an array is.

    Its parameters are an object, what is known, a number of dimensions, flags, the number of a type, and where it
    writes. It sets an error of Python unless the object is an array of this type with these dimensions and flags.
    """
    kind = ir.FunctionType(ir.VoidType(), [OBJECT, OBJECT, SHORT, SHORT, SHORT, INTEGER.as_pointer()])
    function = ir.Function(module, kind, "skillc_take_array")
    function.linkage = "internal"
    array, known, axes, flags, number, place = function.args
    begin, is_array, fits, fail = (function.append_basic_block(each) for each in ("begin", "is_array", "fits", "fail"))
    builder = ir.IRBuilder(begin)
    of_type = ir.Function(module, ir.FunctionType(SHORT, [OBJECT, OBJECT]), "PyObject_IsInstance")
    found = builder.call(of_type, [array, get_known(builder, known, ARRAY_TYPE)])
    builder.cbranch(builder.icmp_signed("==", found, SHORT(1)), is_array, fail)
    builder.position_at_end(is_array)
    described = _load(builder, array, TYPE, OBJECT)
    conditions = (
        builder.icmp_signed("==", _load(builder, array, AXES, SHORT), axes),
        builder.icmp_signed("==", builder.and_(_load(builder, array, FLAGS, SHORT), flags), flags),
        builder.icmp_signed("==", _load(builder, described, NUMBER, SHORT), number),
        builder.icmp_signed("!=", _load(builder, described, ORDER, BYTE), BYTE(SWAPPED)),
    )
    both = [builder.and_(*conditions[:2]), builder.and_(*conditions[2:])]
    builder.cbranch(builder.and_(*both), fits, fail)
    builder.position_at_end(fits)
    last = builder.zext(builder.sub(axes, SHORT(1)), INTEGER)
    builder.store(_load(builder, array, DATA, INTEGER), place)
    for row, offset in ((1, SHAPE), (3, STRIDES)):
        sizes = _load(builder, array, offset, INTEGER.as_pointer())
        builder.store(builder.load(sizes), builder.gep(place, [INTEGER(row)]))
        builder.store(builder.load(builder.gep(sizes, [last])), builder.gep(place, [INTEGER(row + 1)]))
    builder.ret_void()
    builder.position_at_end(fail)
    raise_error(context, builder, known, TYPE_ERROR, f"{function_name}: not an array as it is annotated")
    builder.ret_void()
    return function


def define_runtime(module: Any) -> None:
    """Define the functions of numba's runtime that `np.empty` and `reshape` call."""
    malloc = ir.Function(module, ir.FunctionType(OBJECT, [INTEGER]), "malloc")
    free = ir.Function(module, ir.FunctionType(ir.VoidType(), [OBJECT]), "free")
    for name, last in (("NRT_MemInfo_alloc_aligned", SHORT), ("NRT_MemInfo_alloc_safe_aligned", SHORT)):
        builder, (size, _) = _begin(module, name, OBJECT, [INTEGER, last])
        block = builder.call(malloc, [builder.add(size, INTEGER(BLOCK + ALIGNMENT))])
        after = builder.add(builder.ptrtoint(block, INTEGER), INTEGER(BLOCK + ALIGNMENT - 1))
        builder.store(INTEGER(1), builder.bitcast(block, INTEGER.as_pointer()))
        builder.store(builder.and_(after, INTEGER(-ALIGNMENT)), _field(builder, block, 24, INTEGER))
        builder.ret(block)
    builder, (block,) = _begin(module, "NRT_MemInfo_data_fast", OBJECT, [OBJECT])
    builder.ret(_load(builder, block, 24, OBJECT))
    builder, (block,) = _begin(module, "NRT_MemInfo_call_dtor", ir.VoidType(), [OBJECT])
    builder.call(free, [block])
    builder.ret_void()
    _define_reshape(module)


def _define_reshape(module: Any) -> None:
    """Define a function that computes the strides of an array in C order with one or two dimensions."""
    sizes = INTEGER.as_pointer()
    takes = [INTEGER, sizes, sizes, INTEGER, sizes, sizes, INTEGER, SHORT]
    builder, (*_, axes, shape, strides, item, _) = _begin(module, "numba_attempt_nocopy_reshape", SHORT, takes)
    last = builder.sub(axes, INTEGER(1))
    builder.store(item, builder.gep(strides, [last]))
    with builder.if_then(builder.icmp_signed(">", last, INTEGER(0))):
        row = builder.mul(item, builder.load(builder.gep(shape, [last])))
        builder.store(row, builder.gep(strides, [builder.sub(last, INTEGER(1))]))
    builder.ret(SHORT(1))


def _begin(module: Any, name: str, returns: Any, takes: list[Any]) -> tuple[Any, Any]:
    function = ir.Function(module, ir.FunctionType(returns, takes), name)
    return ir.IRBuilder(function.append_basic_block()), function.args


def _field(builder: Any, pointer: Any, offset: int, kind: Any) -> Any:
    return builder.bitcast(builder.gep(pointer, [INTEGER(offset)]), kind.as_pointer())


def _load(builder: Any, pointer: Any, offset: int, kind: Any) -> Any:
    return builder.load(_field(builder, pointer, offset, kind))
