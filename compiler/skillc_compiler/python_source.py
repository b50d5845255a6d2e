"""What a Python module defines, read from its text: nothing is imported or run."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from importlib.machinery import ModuleSpec, PathFinder
from importlib.util import find_spec
from pathlib import Path
from typing import TypeAlias

Function: TypeAlias = ast.FunctionDef | ast.AsyncFunctionDef
Definition: TypeAlias = ast.ClassDef | Function


@dataclass(frozen=True, slots=True)
class NoModule:
    """There is no such module; `installed` if the package it should be in is there."""

    installed: bool


@dataclass(frozen=True, slots=True)
class NoName:
    """The module defines nothing of that name, but `there`."""

    there: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Signature:
    """What can be passed: `names` in order, `needed` those without a default; with `more`, anything else too."""

    names: tuple[str, ...]
    needed: frozenset[str]
    more: bool


@dataclass(frozen=True, slots=True)
class Unclear:
    """The text alone does not tell."""


Found: TypeAlias = NoModule | NoName | Signature | Unclear
UNCLEAR = Unclear()
NOTHING = Signature((), frozenset(), more=False)


def signature(module: str, name: str) -> Found:
    """Return what can be passed to a function or class of a module, besides `self` and one argument that we pass."""
    found = _definition(module, name, frozenset())
    match found:
        case (where, ast.ClassDef() as cls):
            return _constructor(where, cls, frozenset())
        case (_, ast.FunctionDef() | ast.AsyncFunctionDef() as function):
            return _taken(function, 1)
        case NoModule() | NoName() | Unclear():
            return found
        case _:
            return UNCLEAR


def _definition(module: str, name: str, seen: frozenset[str]) -> tuple[str, Definition] | NoModule | NoName | Unclear:
    """Find where a name is really defined, following imports."""
    file = _file(module)
    if isinstance(file, NoModule | Unclear):
        return file
    names = _names(file, file.stat().st_mtime_ns)
    match names.get(name):
        case ast.ClassDef() | ast.FunctionDef() | ast.AsyncFunctionDef() as definition:
            return module, definition
        case ast.ImportFrom(module=str(other), level=0, names=aliases) if other not in seen:
            original = next(alias.name for alias in aliases if name in (alias.asname, alias.name))
            return _definition(other, original, seen | {module})
        case None if "*" not in names and "__getattr__" not in names:
            return NoName(tuple(sorted(n for n, node in names.items() if isinstance(node, Definition))))
    return UNCLEAR


def _file(module: str) -> Path | NoModule | Unclear:
    """Return the file of a module; packages on the way are not imported."""
    first, *rest = module.split(".")
    spec = find_spec(first)
    if spec is None:
        return NoModule(installed=False)
    for depth, _ in enumerate(rest, 2):
        spec = _below(spec, ".".join(module.split(".")[:depth]))
        if spec is None:
            return NoModule(installed=True)
    return Path(spec.origin) if spec.origin and spec.origin.endswith(".py") else UNCLEAR


def _below(package: ModuleSpec, name: str) -> ModuleSpec | None:
    places = package.submodule_search_locations
    return PathFinder.find_spec(name, list(places)) if places is not None else None


@lru_cache(maxsize=256)
def _names(file: Path, _changed_ns: int) -> Mapping[str, ast.stmt]:
    """Return what a file's text defines at its top, by name; nothing if it is no Python."""
    try:
        return dict(_bound(ast.parse(file.read_bytes()).body))
    except SyntaxError:
        return {"*": ast.Pass()}


def _bound(body: Iterable[ast.stmt]) -> Iterator[tuple[str, ast.stmt]]:
    for node in body:
        match node:
            case ast.ClassDef(name=name) | ast.FunctionDef(name=name) | ast.AsyncFunctionDef(name=name):
                yield name, node
            case ast.Import(names=aliases) | ast.ImportFrom(names=aliases):
                yield from ((alias.asname or alias.name, node) for alias in aliases)
            case ast.Assign(targets=targets):
                yield from ((target.id, node) for target in targets if isinstance(target, ast.Name))
            case ast.If(body=then, orelse=orelse) | ast.Try(body=then, orelse=orelse):
                yield from _bound((*then, *orelse))
            case _:
                pass


def _constructor(module: str, cls: ast.ClassDef, seen: frozenset[str]) -> Signature | Unclear:
    own = [part for part in cls.body if isinstance(part, Function) and part.name == "__init__"]
    if own:
        return _taken(own[0], 2)
    if cls.decorator_list or cls.keywords or cls.name in seen:
        return UNCLEAR
    for base in cls.bases:
        found = _definition(module, base.id, frozenset()) if isinstance(base, ast.Name) else UNCLEAR
        match found:
            case (where, ast.ClassDef() as parent):
                return _constructor(where, parent, seen | {cls.name})
            case _:
                return UNCLEAR
    return NOTHING


def _taken(function: Function, passed: int) -> Signature:
    """Return a function's parameters without the first `passed`, which are given by position."""
    arguments = function.args
    positional = [*arguments.posonlyargs, *arguments.args]
    optional = positional[len(positional) - len(arguments.defaults) :]
    optional += [name for name, default in zip(arguments.kwonlyargs, arguments.kw_defaults, strict=True) if default]
    names = [*positional[passed:], *arguments.kwonlyargs]
    needed = frozenset(each.arg for each in names if each not in optional)
    more = arguments.kwarg is not None or arguments.vararg is not None
    return Signature(tuple(each.arg for each in names), needed, more)
