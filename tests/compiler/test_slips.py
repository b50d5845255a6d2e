"""One slip of the pen anywhere in a shipped library is one error of the whole compiler, at its place.

`SLIPS=2000` tries so many.
"""

import os
from functools import cache

from mutations import Mutation, is_grammatical, mutation
from shipped import library, shelf, vocabulary

from skillc_compiler.pipeline import compile
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Source

TRIED = int(os.environ.get("SLIPS", "60"))


@cache
def sources() -> tuple[Source, ...]:
    """Return the standard library and the wiping library as one."""
    standard = [Source(name, source.text) for name, source in shelf().items()]
    return (*standard, *library("wiping"))


def slipped(seed: int) -> tuple[str, Mutation, list[Diagnostic]]:
    """Return the file with the slip, the slip, and the errors."""
    index = seed % len(sources())
    slip = mutation(sources()[index].text, seed)
    changed = [Source(each.path, slip.text) if at == index else each for at, each in enumerate(sources())]
    told = compile(changed, vocabulary(), {}, "own").diagnostics
    return sources()[index].path, slip, [each for each in told if each.severity == "error"]


def is_near(path: str, slip: Mutation, error: Diagnostic) -> bool:
    """Whether an error is shown within a line of a slip."""
    return error.span.path == path and any(abs(error.span.line - line) <= 1 for line in slip.lines)


def test_a_slip_that_breaks_the_grammar_is_one_error_at_its_place() -> None:
    broken, several, strayed = 0, [], []
    for seed in range(TRIED):
        path, slip, errors = slipped(seed)
        if is_grammatical(slip.text):
            continue
        broken += 1
        shown = f"{seed}: {path}:{slip.told}: {[(each.span.path, each.span.line, each.name) for each in errors]}"
        if len(errors) != 1:
            several.append(shown)
        if not any(is_near(path, slip, error) for error in errors):
            strayed.append(shown)
    assert broken > TRIED // 2
    assert strayed == []
    assert len(several) <= 0.05 * broken, "\n".join(several)
