"""Libraries in different styles have no problem, and each of the edits at their ends gives exactly one, as named."""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from shipped import shelf, vocabulary

from skillc_compiler.pipeline import compile
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Source

FOLDER = Path(__file__).parent.parent / "cases" / "libraries"
LIBRARIES = sorted(FOLDER.glob("*.skill"))
EDIT = re.compile(r'^#% ([a-z-]+) +"(.*)" -> "(.*)"$', re.MULTILINE)


def edits() -> Iterator[tuple[str, str, str, str]]:
    """Yield each edit: the library, the diagnostic, the text and what comes into its place."""
    for path in LIBRARIES:
        for name, old, new in EDIT.findall(path.read_text()):
            yield path.stem, name, old.replace("\\n", "\n"), new.replace("\\n", "\n")


def text_of(library: str) -> str:
    """Return a library without the edits at its end."""
    whole = next(path for path in LIBRARIES if path.stem == library).read_text()
    return re.sub(r"^#% .*\n", "", whole, flags=re.MULTILINE)


def problems(text: str) -> tuple[Diagnostic, ...]:
    """Check and compile."""
    return compile([Source("m.skill", text)], vocabulary(), shelf(), "own").diagnostics


@pytest.mark.parametrize("library", [path.stem for path in LIBRARIES])
def test_a_correct_library_has_no_problem(library: str) -> None:
    assert problems(text_of(library)) == ()


@pytest.mark.slow
@pytest.mark.parametrize(("library", "name", "old", "new"), list(edits()), ids=lambda part: part[:24])
def test_one_mistake_gives_one_error(library: str, name: str, old: str, new: str) -> None:
    text = text_of(library)
    assert text.count(old) >= 1
    found = problems(text.replace(old, new, 1))
    assert [d.name for d in found] == [name], [(d.name, d.span.line, d.message) for d in found]


def test_a_name_that_a_quantifier_binds_is_not_the_caller_s() -> None:
    text = (
        "use skiros\n"
        "relation rests(Product, Location)\n"
        "skill Look { in thing: Product  in place: Location\n"
        "    pre exists p: Product (p rests place and not p == thing)  noplan }\n"
        'impl one of Look { run python "skillc.primitives:StandIn" }\n'
        "skill Ask { in p: Product  in place: Location\n"
        "    pre exists q: Product (q rests place and not q == p)  noplan }\n"
        "impl one of Ask { do Look(thing: p, place) }\n"
    )
    assert problems(text) == ()
    assert [d.name for d in problems(text.replace("not q == p", "q == p"))] == ["child-precondition"]
