"""Makes the clients of programs that wait from those with asyncio: the same methods, which return when all is done."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from clients.formatting import CLIENT, format_module

FINAL = {"AsyncServer": "Server", "AsyncCell": "ServerCell", "AsyncOperation": "ServerOperation"}
Method = ast.FunctionDef | ast.AsyncFunctionDef
IMPORTS = ast.ImportFrom | ast.Import


@dataclass(frozen=True, slots=True)
class Waiting:
    """A module with a class that waits: what it is about, its document, and that of the class."""

    kind: str
    about: str
    document: str

    @property
    def file(self) -> Path:
        """Where it is."""
        return CLIENT / f"{self.kind}.py"

    @property
    def source(self) -> str:
        """The name of the module of the class with asyncio."""
        return f"async_{self.kind}"


WAITING = (
    Waiting(
        "server", "A server",
        "A server; its methods are those of `AsyncServer`, and wait. They may be called from any thread.\n\n    "
        "As a context manager it closes the connection; what goes on in the server goes on.\n    ",
    ),
    Waiting("cell", "A cell of a server", "A cell of a server; its methods are those of `AsyncCell`, and wait."),
    Waiting(
        "operation", "An operation of a server",
        "An operation of a server; its methods are those of `AsyncOperation`, and wait.\n\n    "
        "Its properties ask the server each time, but for `id` and `task`.\n    ",
    ),
)  # fmt: skip


def make_waiting(wanted: Waiting) -> str:
    """Return the text of a module."""
    calls, written, bases = (_read(each) for each in ("calls", wanted.source, "waiting"))
    name = wanted.kind.capitalize()
    own = {each.name for each in _find_class(bases, f"Waiting{name}").body if isinstance(each, Method)}
    classes = (_find_class(calls, f"{name}Calls"), _find_class(written, f"Async{name}"))
    methods = [_write(each) for known in classes for each in _list_methods(known) if each.name not in own]
    imports = [ast.unparse(each) for module in (calls, written) for each in module.body if isinstance(each, IMPORTS)]
    final = FINAL[f"Async{name}"]
    more = (*_import_constants(wanted.source, written), *_import_final(final), "from collections.abc import Iterator")
    head = f'"""{wanted.about}; made from `async_{wanted.kind}` by `python tests/accept.py`, not edited."""\n\n'
    text = "\n".join((*imports, *more, f"from skillc.client.waiting import Waiting{name}"))
    body = f'class {final}(Waiting{name}):\n    """{wanted.document}"""\n\n' + "\n\n".join(methods)
    return format_module(f"{head}{text}\n\n\n{body}\n", wanted.file)


def _read(module: str) -> ast.Module:
    return ast.parse((CLIENT / f"{module}.py").read_text("utf-8"))


def _find_class(module: ast.Module, name: str) -> ast.ClassDef:
    return next(each for each in module.body if isinstance(each, ast.ClassDef) and each.name == name)


def _list_methods(known: ast.ClassDef) -> Iterator[Method]:
    """Yield the methods of a class that programs call."""
    for each in known.body:
        if isinstance(each, Method) and each.name[0] != "_" and not each.decorator_list and each.name != "refresh":
            yield each


def _import_constants(source: str, written: ast.Module) -> Iterator[str]:
    """Yield the imports of what the module with asyncio itself defines, such as the defaults of parameters."""
    for each in written.body:
        targets = (
            each.targets if isinstance(each, ast.Assign) else [each.target] if isinstance(each, ast.AnnAssign) else []
        )
        for target in targets:
            names = target.elts if isinstance(target, ast.Tuple) else [target]
            yield from (f"from skillc.client.{source} import {name.id}" for name in names if isinstance(name, ast.Name))


def _import_final(own: str) -> Iterator[str]:
    modules = {"ServerCell": "cell", "ServerOperation": "operation"}
    yield from (f"from skillc.client.{module} import {name}" for name, module in modules.items() if name != own)


def _write(method: Method) -> str:
    """Return a method that waits."""
    document = (ast.get_docstring(method, clean=False) or "").rstrip(" ")
    shown = f'"""{document}{"    " * 2 if document.endswith(chr(10)) else ""}"""'
    returns = ast.unparse(method.returns) if method.returns else "None"
    parameters = ast.unparse(method.args)
    call = f"self._client.{method.name}({_pass_on(method.args)})"
    if returns.startswith("AsyncGenerator["):
        returned, value = f"Iterator[{returns[15:-1].rpartition(', ')[0]}]", f"return self._loop.iterate({call})"
    else:
        returned, value = _wrap(returns, f"self._loop.run({call})")
    return f"    def {method.name}({parameters}) -> {returned}:\n        {shown}\n        {value}\n"


def _wrap(returns: str, value: str) -> tuple[str, str]:
    """Return what a method that waits returns instead, and the statement that does."""
    for asynchronous, final in FINAL.items():
        if returns == asynchronous:
            return final, f"return {final}(self._loop, {value})"
        if returns == f"tuple[{asynchronous}, ...]":
            return f"tuple[{final}, ...]", f"return tuple({final}(self._loop, each) for each in {value})"
    return returns, value if returns == "None" else f"return {value}"


def _pass_on(parameters: ast.arguments) -> str:
    """Return the arguments with which a method calls one that has the same parameters."""
    positional = [each.arg for each in (*parameters.posonlyargs, *parameters.args)][1:]
    parts = [*positional, *((f"*{parameters.vararg.arg}",) if parameters.vararg else ())]
    parts += [f"{each.arg}={each.arg}" for each in parameters.kwonlyargs]
    return ", ".join((*parts, *((f"**{parameters.kwarg.arg}",) if parameters.kwarg else ())))
