"""Makes all artifacts of a library; each module of this package with a function `emit` is an emitter."""

from __future__ import annotations

from importlib import import_module
from pkgutil import iter_modules
from typing import Protocol, cast

import skillc_compiler.emit as folder
from skillc_compiler.emit.headers import add_header
from skillc_model.skills import SkillLibrary


class Emitter(Protocol):
    """The interface of an emitter module."""

    def emit(self, library: SkillLibrary) -> dict[str, str]:
        """Return the text of each artifact, without header, by its relative path with `/` as separator."""
        ...


def make_artifacts(library: SkillLibrary) -> dict[str, str]:
    """Return all artifacts by relative path, sorted by path; ValueError if two emitters produce the same path."""
    found: dict[str, str] = {}
    for emitter in find_emitters():
        for path, text in emitter.emit(library).items():
            if path in found:
                raise ValueError(f"two emitters write {path}")
            found[path] = add_header(path, text, library)
    return dict(sorted(found.items()))


def find_emitters() -> tuple[Emitter, ...]:
    """Return the emitters, sorted by name."""
    names = sorted(module.name for module in iter_modules(folder.__path__) if module.name != "artifacts")
    modules = [import_module(f"{folder.__name__}.{name}") for name in names]
    return tuple(cast(Emitter, module) for module in modules if hasattr(module, "emit"))
