"""Controllers that scenes name and that there are not."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches

import pyoxigraph as ox

from skillc_compiler.turtle.statements import Statement
from skillc_dsl.diagnostics import Diagnostic, Fix, did_you_mean
from skillc_dsl.source import Span
from skillc_runtime.commands._diagnostics import with_shown_path
from skillc_runtime.control.gains import CONTROLLERS
from skillc_runtime.scene.load import Scene
from skillc_runtime.world.state.terms import COMPLIANT_CONTROLLER


def unknown_controllers(scene: Scene, path: str) -> Iterator[Diagnostic]:
    """Yield the places in the scene file at `path` where an arm names a controller that there is not."""
    named = [each for each in scene.said if each.predicate == COMPLIANT_CONTROLLER and each.lines.path == path]
    known = tuple(CONTROLLERS)
    for each in named:
        name = _text(each)
        if name not in known:
            span, message = (
                with_shown_path(each.object_place),
                f'there is no controller "{name}"; there are: {", ".join(known)}',
            )
            yield Diagnostic(
                "unknown-controller", span, message, did_you_mean(name, known), fix=_fix(span, name, known)
            )


def _fix(span: Span, name: str, known: tuple[str, ...]) -> Fix | None:
    near = get_close_matches(name, known, n=1)
    return Fix(span, f'"{near[0]}"', f'write "{near[0]}"', safe=False) if near else None


def _text(said: Statement) -> str:
    return said.object.value if isinstance(said.object, ox.Literal) else str(said.object)
