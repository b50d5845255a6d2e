"""How many errors a mistake gives: random edits of libraries, judged by the errors of the whole compiler.

An edit counts if there is an error after it. Run it as `python benchmarks/mutations.py [EDITS] [SEED] [COUNT]`; it
prints, for shipped and for other libraries, the share of edits with exactly one error for each of COUNT mistakes
(default 1), with an error within one line of it, with warnings beside it, then the diagnostics that follow others.
"""

from __future__ import annotations

import random
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

TESTS = Path(__file__).parent.parent / "tests" / "compiler"
sys.path.insert(0, str(TESTS))

from shipped import SKILLS, library, shelf, vocabulary  # noqa: E402
from single_edits import Edit, apply_edits, describe, edited_lines, independent_edits, single_edit  # noqa: E402
from test_libraries import LIBRARIES, text_of  # noqa: E402

from skillc_compiler.pipeline import compile  # noqa: E402
from skillc_dsl import syntax as s  # noqa: E402
from skillc_dsl.diagnostics import Diagnostic, Outcome  # noqa: E402
from skillc_dsl.parsing.parser import parse  # noqa: E402
from skillc_dsl.source import Source  # noqa: E402


@cache
def parsed(source: Source) -> Outcome[s.File]:
    """Parse a source once."""
    return parse(source)


@dataclass
class Tally:
    """What was found for the edits of one kind of library."""

    tried: int = 0
    wrong: int = 0
    exact: int = 0
    near: int = 0
    clean: int = 0
    crashed: int = 0
    followers: Counter[str] = field(default_factory=Counter)
    shown: list[str] = field(default_factory=list)


def shipped_libraries() -> list[list[Source]]:
    """Return each shipped library with the standard library as one."""
    standard = [Source(name, source.text) for name, source in shelf().items()]
    names = sorted(path.name for path in SKILLS.iterdir() if path.is_dir() and path.name not in ("std", "__pycache__"))
    return [[*standard, *library(name)] for name in names if library(name)]


def other_libraries() -> list[list[Source]]:
    """Return the libraries of other authors, one file each, with what they import of the standard library."""
    return [[Source("m.skill", text_of(path.stem))] for path in LIBRARIES]


def problems(sources: Sequence[Source], importable: dict[str, Source]) -> tuple[Diagnostic, ...]:
    """Compile."""
    return compile(sources, vocabulary(), importable, "own", parsed_by=parsed).diagnostics


def measure(libraries: list[list[Source]], importable: dict[str, Source], seeds: range, count: int) -> Tally:
    """Try one edit for each seed."""
    tally = Tally()
    before = [{(d.span.path, d.name) for d in problems(each, importable)} for each in libraries]
    for seed in seeds:
        chance = random.Random(seed * 7919 + count)
        index = chance.randrange(len(libraries))
        sources = libraries[index]
        at = chance.choices(range(len(sources)), [len(each.text) for each in sources])[0]
        text = sources[at].text
        edits = (single_edit(text, seed),) if count == 1 else independent_edits(text, seed, count)
        if len(edits) < count or apply_edits(text, edits) == text:
            continue
        changed = [Source(each.path, apply_edits(text, edits)) if n == at else each for n, each in enumerate(sources)]
        tally.tried += 1
        try:
            found = [d for d in problems(changed, importable) if (d.span.path, d.name) not in before[index]]
        except Exception as error:  # noqa: BLE001  a crash is what is looked for
            tally.crashed += 1
            print(f"crash {seed} {sources[at].path} {[describe(text, e) for e in edits]}: {error!r}", file=sys.stderr)
            continue
        judge(tally, sources[at].path, text, edits, found, seed, count)
    return tally


def judge(
    tally: Tally, path: str, text: str, edits: Sequence[Edit], found: list[Diagnostic], seed: int, count: int
) -> None:
    """Count what was found."""
    errors = [each for each in found if each.severity == "error"]
    if len(errors) < (1 if count == 1 else count):
        return
    tally.wrong += 1
    tally.exact += len(errors) == count
    near = all(any(is_near(path, text, edit, edits, error) for error in errors) for edit in edits)
    tally.near += near
    tally.clean += len(found) == count
    if len(errors) != count or not near or len(found) != count:
        flag = f"{'E' if len(errors) != count else '-'}{'N' if not near else '-'}{'W' if len(found) != count else '-'}"
        names = [f"{d.span.path}:{d.span.line}:{d.name}" for d in found]
        tally.shown.append(f"{flag} {seed} {path} {'; '.join(describe(text, e) for e in edits)} => {names}")
        tally.followers.update(sorted({d.name for d in found}))


def is_near(path: str, text: str, edit: Edit, edits: Sequence[Edit], error: Diagnostic) -> bool:
    """Whether an error, or a place that it points to, is within a line of an edit."""
    shift = sum(
        other.new.count("\n") - text.count("\n", other.start, other.end) for other in edits if other.end <= edit.start
    )
    lines = edited_lines(text, edit)
    places = (error.span, *(label.span for label in error.labels))
    return any(place.path == path and lines.start - 1 <= place.line - shift <= lines.stop for place in places)


def report(name: str, tally: Tally) -> Iterator[str]:
    """Yield the lines of the report."""
    wrong = max(1, tally.wrong)
    yield (
        f"{name:10} {tally.tried:6} {tally.wrong:6} {tally.exact / wrong:7.2%} {tally.near / wrong:7.2%} "
        f"{tally.clean / wrong:7.2%} {tally.crashed:7}"
    )


def main() -> None:
    """Print the shares, and the cases that are not as they should be to the standard error."""
    edits, seed, count = (int(given) for given in (*sys.argv[1:], *("1000", "0", "1")[len(sys.argv) - 1 :]))
    print(f"{'libraries':10} {'tried':>6} {'wrong':>6} {'exact':>7} {'near':>7} {'alone':>7} {'crashed':>7}")
    for name, libraries, importable in (
        ("shipped", shipped_libraries(), {}),
        ("other", other_libraries(), shelf()),
    ):
        tally = measure(libraries, importable, range(seed, seed + edits), count)
        print("\n".join(report(name, tally)), flush=True)
        print("\n".join(tally.shown), file=sys.stderr)
        print(f"   {tally.followers.most_common(30)}", file=sys.stderr)


if __name__ == "__main__":
    main()
