"""Fixes of many errors are tried together: a compilation for each would take many times as long as the first."""

from collections.abc import Sequence

from shipped import shelf, vocabulary

from skillc_compiler.diagnostics.fixes import keep_useful_fixes
from skillc_compiler.pipeline import analyse
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Source

HEAD = "use rparts, skillc\n"
GOOD = "skill S{} {{\n in arm: ArmDevice\n pre armm.deviceState == Idle\n}}\n"
MANY = 16


def check(sources: Sequence[Source]) -> tuple[Diagnostic, ...]:
    """Return the problems of a library."""
    return analyse(sources, vocabulary(), shelf(), "own").diagnostics


def tried(text: str) -> tuple[list[bool], int]:
    """Return which of the errors with a fix keep it, and how often the text was checked for that."""
    sources = [Source("own.skill", text)]
    texts: list[Sequence[Source]] = []

    def counted(changed: Sequence[Source]) -> tuple[Diagnostic, ...]:
        texts.append(changed)
        return check(changed)

    problems = check(sources)
    fixable = [at for at, each in enumerate(problems) if each.fix is not None and each.severity == "error"]
    found = keep_useful_fixes(problems, sources, counted)
    return [found[at].fix is not None for at in fixable], len(texts)


def test_useful_fixes_are_tried_together() -> None:
    text = HEAD + "".join(map(GOOD.format, range(MANY)))
    assert tried(text) == ([True] * MANY, 1)
