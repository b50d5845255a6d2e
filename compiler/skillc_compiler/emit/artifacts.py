"""All artifacts of a library: every module here that has a function `emit` is an emitter."""

from __future__ import annotations

from importlib import import_module
from pkgutil import iter_modules
from typing import Protocol, cast

import skillc_compiler.emit as folder
from skillc_compiler.emit.headers import add_header
from skillc_model.skills import SkillLibrary


class Emitter(Protocol):
    """What an emitter's module offers."""

    def emit(self, library: SkillLibrary) -> dict[str, str]:
        """Return the text of each artifact by its relative path, with `/` between folders, without header."""
        ...


def make_artifacts(library: SkillLibrary) -> dict[str, str]:
    """Return every artifact by relative path, in order of path; ValueError when two emitters want the same path."""
    found: dict[str, str] = {}
    for emitter in find_emitters():
        for path, text in emitter.emit(library).items():
            if path in found:
                raise ValueError(f"two emitters write {path}")
            found[path] = add_header(path, text, library)
    return dict(sorted(found.items()))


def find_emitters() -> tuple[Emitter, ...]:
    """Return the emitters, in order of their names."""
    names = sorted(module.name for module in iter_modules(folder.__path__) if module.name != "artifacts")
    modules = [import_module(f"{folder.__name__}.{name}") for name in names]
    return tuple(cast(Emitter, module) for module in modules if hasattr(module, "emit"))
