"""Finds where the names of a module are defined, through imports, re-exports, `import *` and aliases."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from importlib.machinery import ModuleSpec, PathFinder
from importlib.util import find_spec
from pathlib import Path
from typing import TypeAlias

import msgspec

from skillc_compiler.python.info import UNCLEAR, BrokenModule, NoModule, NoName, Other, Unclear

Function: TypeAlias = ast.FunctionDef | ast.AsyncFunctionDef
QualifiedName: TypeAlias = tuple[str, str]
"""A module and a name in it."""


class _Names(msgspec.Struct, frozen=True):
    """The names that a module binds at its top level, and its `import *` lines."""

    bound: Mapping[str, ast.stmt | ast.expr | Unclear]
    stars: tuple[ast.ImportFrom, ...]


class Modules(dict[str, "Module"]):
    """Modules by name, each of which is looked for and read once."""

    def __missing__(self, name: str) -> Module:
        self[name] = Module(name, self)
        return self[name]

    def are_current(self) -> bool:
        """Whether each of them is where it was found, and has not changed since."""
        return all(each.state == Module(name, self).state for name, each in self.items())


@dataclass(frozen=True, eq=False)
class Module:
    """A module, perhaps missing; `others` are those that it can import."""

    name: str
    others: Modules

    @cached_property
    def file(self) -> Path | NoModule | Unclear:
        """The file of the module; packages above it are not imported."""
        return _find_file(self.name)

    @cached_property
    def state(self) -> tuple[Path | NoModule | Unclear, int]:
        """Where the module is, and when its file was changed last; 0 without one."""
        try:
            return self.file, self.file.stat().st_mtime_ns if isinstance(self.file, Path) else 0
        except OSError:
            return UNCLEAR, 0

    @cached_property
    def names(self) -> _Names | NoModule | BrokenModule | Unclear:
        """The names in the module."""
        file, changed_ns = self.state
        return _parse_names(file, changed_ns) if isinstance(file, Path) else file

    @property
    def is_there(self) -> bool:
        """Whether there is such a module, in a file of Python."""
        return isinstance(self.file, Path)


class Defined(msgspec.Struct, frozen=True, eq=False):
    """The definition of a class or function, and its module."""

    module: Module
    node: ast.ClassDef | Function


Definition: TypeAlias = Defined | Other | NoModule | BrokenModule | NoName | Unclear


def find_definition(module: Module, name: str, seen: frozenset[QualifiedName] = frozenset()) -> Definition:
    """Return where a name of a module is defined."""
    names = module.names
    if not isinstance(names, _Names):
        return names
    if (module.name, name) in seen:
        return UNCLEAR
    seen |= {(module.name, name)}
    match names.bound.get(name):
        case ast.ClassDef() | ast.FunctionDef() | ast.AsyncFunctionDef() as node:
            return Defined(module, node)
        case ast.ImportFrom() as line:
            found = find_definition(_imported_module(module, line), _original_name(line, name), seen)
            return Other() if isinstance(found, NoName) and _module_at(module, ast.Name(name)) else found
        case ast.Import() | ast.Constant() | ast.JoinedStr() | ast.List() | ast.Dict() | ast.Tuple() | ast.Set():
            return Other()
        case ast.Name() | ast.Attribute() as alias:
            return resolve_expression(module, alias, seen)
        case None:
            return _find_starred(module, name, names, seen)
        case _:
            return UNCLEAR


def resolve_expression(module: Module, written: ast.expr, seen: frozenset[QualifiedName] = frozenset()) -> Definition:
    """Return the definition of a name, or of a name in an imported module."""
    match written:
        case ast.Name(id=name):
            return find_definition(module, name, seen)
        case ast.Attribute(value=value, attr=name):
            of = _module_at(module, value)
            return find_definition(of, name, seen) if of else UNCLEAR
        case ast.Subscript(value=value):
            return resolve_expression(module, value, seen)
        case _:
            return UNCLEAR


def dotted_name(module: Module, written: ast.expr) -> str:
    """Return the "module.name" that an expression imports, as far as its file determines it; else as written."""
    match written:
        case ast.Call(func=func):
            return dotted_name(module, func)
        case ast.Attribute(value=value, attr=name):
            of = _module_at(module, value)
            return f"{of.name if of else dotted_name(module, value)}.{name}"
        case ast.Name(id=name):
            names = module.names
            line = names.bound.get(name) if isinstance(names, _Names) else None
            if isinstance(line, ast.ImportFrom):
                return f"{_imported_module(module, line).name}.{_original_name(line, name)}"
            return name
    return ""


def _find_starred(module: Module, name: str, names: _Names, seen: frozenset[QualifiedName]) -> Definition:
    """Return what `import *` provides; the last line that has the name wins."""
    if "__getattr__" in names.bound:
        return UNCLEAR
    if not name.startswith("_"):
        for line in reversed(names.stars):
            found = find_definition(_imported_module(module, line), name, seen)
            if not isinstance(found, NoName):
                return found if isinstance(found, Defined | Other) else UNCLEAR
    return NoName(tuple(sorted(n for n, node in names.bound.items() if isinstance(node, ast.ClassDef | Function))))


def _module_at(module: Module, written: ast.expr) -> Module | None:
    """Return the module that an expression denotes, None if it denotes none."""
    others = module.others
    match written:
        case ast.Attribute(value=value, attr=name):
            of = _module_at(module, value)
            return _if_there(others[f"{of.name}.{name}"]) if of else None
        case ast.Name(id=name):
            names = module.names
            match names.bound.get(name) if isinstance(names, _Names) else None:
                case ast.Import(names=aliases):
                    alias = next(each for each in aliases if name in (each.asname, each.name.partition(".")[0]))
                    return others[alias.name if alias.asname else alias.name.partition(".")[0]]
                case ast.ImportFrom() as line:
                    return _if_there(others[f"{_imported_module(module, line).name}.{_original_name(line, name)}"])
    return None


def _if_there(module: Module) -> Module | None:
    return module if module.is_there else None


def _imported_module(module: Module, line: ast.ImportFrom) -> Module:
    """Return the module that an import line imports from, with relative imports resolved."""
    if line.level == 0:
        return module.others[line.module or ""]
    is_package = isinstance(module.file, Path) and module.file.name == "__init__.py"
    parts = module.name.split(".") if is_package else module.name.split(".")[:-1]
    around = parts[: len(parts) - line.level + 1]
    return module.others[".".join([*around, *([line.module] if line.module else [])])]


def _original_name(line: ast.ImportFrom, name: str) -> str:
    return next(alias.name for alias in line.names if name in (alias.asname, alias.name))


def _find_file(module: str) -> Path | NoModule | Unclear:
    """Return the file of a module; packages above it are not imported."""
    first, *rest = module.split(".")
    try:
        spec = find_spec(first) if first else None
    except ValueError:
        return UNCLEAR
    if spec is None:
        return NoModule(installed=False)
    for depth, _ in enumerate(rest, 2):
        spec = _submodule_spec(spec, ".".join(module.split(".")[:depth]))
        if spec is None:
            return NoModule(installed=True)
    return Path(spec.origin) if spec.origin and spec.origin.endswith(".py") else UNCLEAR


def _submodule_spec(package: ModuleSpec, name: str) -> ModuleSpec | None:
    places = package.submodule_search_locations
    return PathFinder.find_spec(name, list(places)) if places is not None else None


@lru_cache(maxsize=256)
def _parse_names(file: Path, _changed_ns: int) -> _Names | BrokenModule | Unclear:
    """Return what the text of a file defines at its top level."""
    try:
        body = ast.parse(file.read_bytes()).body
    except OSError:
        return UNCLEAR
    except SyntaxError as error:
        return BrokenModule(error.lineno or 1, error.msg)
    except (ValueError, RecursionError, MemoryError):
        return UNCLEAR
    bound: dict[str, ast.stmt | ast.expr | Unclear] = {}
    for name, node, sure in _bindings(body, sure=True):
        bound[name] = node if sure or name not in bound else UNCLEAR
    stars = tuple(
        node for name, node, _ in _bindings(body, sure=True) if name == "*" and isinstance(node, ast.ImportFrom)
    )
    return _Names({name: node for name, node in bound.items() if name != "*"}, stars)


def _bindings(body: Iterable[ast.stmt], sure: bool) -> Iterator[tuple[str, ast.stmt | ast.expr | Unclear, bool]]:
    """Yield each name that statements bind, with its value and whether the statement always runs."""
    for node in body:
        match node:
            case ast.ClassDef(name=name) | ast.FunctionDef(name=name) | ast.AsyncFunctionDef(name=name):
                yield name, node, sure
            case ast.Import(names=aliases):
                yield from ((alias.asname or alias.name.partition(".")[0], node, sure) for alias in aliases)
            case ast.ImportFrom(names=aliases):
                yield from ((alias.asname or alias.name, node, sure) for alias in aliases)
            case ast.Assign(targets=targets, value=value):
                yield from (pair for target in targets for pair in _assigned_names(target, value, sure))
            case ast.AnnAssign(target=target, value=ast.expr() as value):
                yield from _assigned_names(target, value, sure)
            case ast.With(body=inner):
                yield from _bindings(inner, sure)
            case ast.If() | ast.For() | ast.While():
                yield from _bindings((*node.body, *node.orelse), sure=False)
            case ast.Try():
                rescue = [line for each in node.handlers for line in each.body]
                yield from _bindings((*node.body, *rescue, *node.orelse, *node.finalbody), sure=False)
            case _:
                pass


def _assigned_names(target: ast.expr, value: ast.expr, sure: bool) -> Iterator[tuple[str, ast.expr | Unclear, bool]]:
    match target:
        case ast.Name(id=name):
            yield name, value, sure
        case ast.Tuple(elts=parts) | ast.List(elts=parts):
            yield from ((part.id, UNCLEAR, sure) for part in parts if isinstance(part, ast.Name))
