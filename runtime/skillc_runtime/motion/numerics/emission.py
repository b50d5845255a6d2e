"""Makes machine code of a function: numba types and lowers it, with all that it calls, into one object file.

Numba would optimise and emit each function that is called by itself, and again in each that calls it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from inspect import get_annotations
from typing import Any

from numba import _dynfunc, config, njit
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Compiler, DefaultPassBuilder, _LowerResult
from numba.core.compiler_machinery import register_pass
from numba.core.registry import cpu_target
from numba.core.runtime import rtsys
from numba.core.typed_passes import NativeLowering
from numba.extending import register_jitable

from skillc_runtime.motion.numerics.callers import add_callers
from skillc_runtime.motion.numerics.machine_code import pack
from skillc_runtime.motion.numerics.machine_types import type_of
from skillc_runtime.motion.numerics.places import is_on_memory


class _Part(JITCodeLibrary):  # type: ignore[misc]
    """Functions that are emitted with those that call them only."""

    def finalize(self) -> None:
        """Do nothing yet."""
        self._finalized = True


@register_pass(mutates_CFG=True, analysis_only=False)
class _PartLowering(NativeLowering):  # type: ignore[misc]
    """Lowers a function without making it executable."""

    _name = "part_lowering"

    def run_pass(self, state: Any) -> bool:
        """Let functions that call this one find it by a function that is never called."""
        state.flags.no_compile = True
        state.library = _Part(state.targetctx.codegen(), state.func_id.func_qualname)
        super().run_pass(state)
        made = state["cr"]
        name = made.fndesc.qualname.split(".")[-1]
        never_called = _dynfunc.make_function(made.fndesc.lookup_module(), name, "", 0, made.env, ())
        state.targetctx.insert_user_function(never_called, made.fndesc, [state.library])
        state["cr"] = _LowerResult(made.fndesc, made.call_helper, cfunc=never_called, env=made.env)
        return True


class _PartCompiler(Compiler):  # type: ignore[misc]
    """Numba's pipeline with the other lowering."""

    def define_pipelines(self) -> list[Any]:
        """Return the only pipeline."""
        passes = DefaultPassBuilder.define_nopython_pipeline(self.state)
        passes.add_pass_after(_PartLowering, NativeLowering)
        passes.passes = [each for each in passes.passes if each[0] is not NativeLowering]
        passes.finalize()
        return [passes]


_OPTIONS = {
    "error_model": "numpy", "no_cpython_wrapper": True, "no_cfunc_wrapper": True, "pipeline_class": _PartCompiler,
}  # fmt: skip


_called: set[Callable[..., Any]] = set()


def let_be_called(functions: Iterable[Callable[..., Any]]) -> None:
    """Let functions that are compiled call these."""
    for each in functions:
        if each not in _called:
            _called.add(each)
            register_jitable(**_OPTIONS)(each)


def find_type(function: Callable[..., Any]) -> Any:
    """Return numba's type of a function that may be called."""
    return cpu_target.typing_context.resolve_value_type(function)


def emit(function: Callable[..., Any], key: str) -> bytes:
    """Return an object file with a function, as `machine_code` describes its parts."""
    annotations = get_annotations(function, eval_str=True)
    returns = annotations.pop("return")
    with _our_settings():
        made = njit(**_OPTIONS)(function)
        is_strided = not is_on_memory(annotations.values())
        made.compile(type_of(returns)(*(type_of(each, is_strided) for each in annotations.values())))
        (part,) = made.overloads.values()
        whole = _Part(part.library.codegen, key)
        module = whole.create_ir_module(key)
        add_callers(module, part, key, annotations, returns)
        whole.add_ir_module(module)
        return _emit(whole, part.library)


def _emit(whole: Any, first: Any) -> bytes:
    """Link and optimise all that the first library needs; only functions of the whole are seen from outside.

    A library comes after those that call it, since what nothing calls yet is not linked; that of the runtime at last.
    """
    final = whole._final_module
    visible = {each.name for each in final.functions if each.name.startswith(whole.name)}
    libraries: list[Any] = []
    _collect(first, libraries)
    for library in sorted(libraries, key=lambda each: each is rtsys.library):
        final.link_in(library._get_module_for_linking(), preserve=True)
    for each in (*final.functions, *final.global_variables):
        if not each.is_declaration and each.name not in visible:
            each.linkage = "internal"
    whole._optimize_final_module()
    needed = [each.name for each in final.functions if each.is_declaration and not each.name.startswith("llvm.")]
    if ours := [each for each in needed if each.startswith(("NRT", "numba"))]:
        raise NotImplementedError(f"{whole.name} needs {', '.join(ours)}, which is not there without numba")
    return pack(needed, whole.codegen._tm.emit_object(final))


def _collect(library: Any, found: list[Any]) -> None:
    """Add a library and those that it needs; numba's own ones have all that they need."""
    if library not in found:
        found.append(library)
        for needed in library._linking_libraries if isinstance(library, _Part) else ():
            _collect(needed, found)


@contextmanager
def _our_settings() -> Iterator[None]:
    """Vectorisation does not speed up loops over three to seven numbers, and makes compiling slower."""
    ours = {"OPT": 1, "LOOP_VECTORIZE": 0}
    assert cpu_target.target_context is not None  # it is made with numba's own settings
    before = {name: getattr(config, name) for name in ours}
    try:
        vars(config).update(ours)
        yield
    finally:
        vars(config).update(before)
