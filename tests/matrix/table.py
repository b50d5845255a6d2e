"""docs/matrix.md: what each feature of the language becomes, as the cases have it."""

from __future__ import annotations

from pathlib import Path

from matrix.case import cases

PAGE = Path(__file__).parents[2] / "docs" / "matrix.md"
HEAD = """# What each feature becomes

Made from the cases in `tests/matrix/cases` by `make accept`; the tests compile each of them, read `library.json` back,
compare what the OWL says with the library, simulate the PDDL step by step against the world model, and run the exported
tree against the engine.

| feature | OWL | PDDL | behaviour tree | execution |
|---|---|---|---|---|
"""


def page() -> str:
    """Return the page."""
    return HEAD + "".join(f"| {' | '.join(row)} |\n" for row in rows())


def rows() -> list[tuple[str, ...]]:
    """Return a row for each case, with what is expected of it."""
    made = []
    for case in cases():
        expected = case.expected
        if "refused" in expected:
            made.append((case.feature, f"refused: `{expected['refused']}`", "", "", ""))
        else:
            made.append((case.feature, *(expected[word] for word in ("owl", "pddl", "bt", "run"))))
    return made
