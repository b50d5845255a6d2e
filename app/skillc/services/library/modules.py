"""The Python modules that a compiled library names."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_model.skills import Primitive, SkillLibrary


def find_modules(library: SkillLibrary) -> Iterator[str]:
    """Yield the Python modules that a library and its vocabulary name."""
    for each in library.implementations.values():
        if isinstance(each.body, Primitive):
            yield module_of(each.body.python)
    known = library.vocabulary
    computed = (
        *(each.computed_by for each in known.relations.values()),
        *(each.computed_by for each in known.properties.values()),
    )
    yield from (module_of(each) for each in computed if each is not None)
    yield from (module_of(each.python) for each in known.functions.values())


def module_of(python: str) -> str:
    """Return the module of "module:attribute"."""
    return python.partition(":")[0]
