"""Cost of compiling a library of 10,000 lines, beside the bare parse of the same text by lark in the same process.

The library is made of copies of the shipped one, without its tests, whose files and terms are renamed in each. Run it
as `python benchmarks/compile.py [LINES]`; it prints the seconds of each stage and the ratio to the bare parse, then
those of whole processes and the ratio to one that only imports click. The tasks are there once: checking them against
their scenes is not the compiler's work.
"""

from __future__ import annotations

import os
import re
import resource
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from statistics import median
from time import process_time
from typing import TypeVar

from lark import Lark

from skillc.services.library.files import SHIPPED
from skillc.services.library.libraries import load_vocabulary
from skillc_compiler.analysis.proof import Prover, prove
from skillc_compiler.checks import load_checks
from skillc_compiler.lower.library import lower_program
from skillc_compiler.pipeline import compile
from skillc_compiler.program.parts import Reads
from skillc_compiler.python.targets import NamedPython, Targets
from skillc_compiler.resolve.files import read_sources
from skillc_compiler.resolve.program import resolve_program
from skillc_dsl.editions import NEWEST
from skillc_dsl.parsing.making import make_parser
from skillc_dsl.parsing.tables import grammar_text
from skillc_dsl.source import Source

Result = TypeVar("Result")
ROUNDS = 9
EDITS = {
    "one line of a body": re.compile(r"(?<=socket\.depth \+ )25 mm"),
    "one signature": re.compile(r"(?<=radius:  Length = )9 mm"),
}
MANIFEST = f'name = "generated"\nedition = {NEWEST}\n'
_DECLARED = re.compile(r"^(?:skill|impl|task|function|class|enum|relation|property)\s+(\w+)", re.MULTILINE)

_FUNCTION = re.compile(r"^function\s+(\w+)", re.MULTILINE)


def generated(lines: int) -> tuple[Source, ...]:
    """Return a library of at least so many lines, made of renamed copies of the shipped one."""
    shipped = {path.relative_to(SHIPPED).as_posix(): path.read_text("utf-8") for path in SHIPPED.glob("*/*.skill")}
    files = _apart({path: text for path, text in sorted(shipped.items()) if "\ntest " not in text})
    each = sum(text.count("\n") for text in files.values() if "\ntask " not in text)
    return tuple(source for number in range(-(-lines // each)) for source in _copy(files, number))


def _apart(files: Mapping[str, str]) -> dict[str, str]:
    """Return files in which no function is declared that one before declares: they are of several libraries."""
    apart: dict[str, str] = {}
    seen: set[str] = set()
    for path, text in files.items():
        own = set(_FUNCTION.findall(text))
        for name in own & seen:
            text = re.sub(rf"(?<!:)\b{name}\b", f"{name}_too", text)
        seen |= own
        apart[path] = text
    return apart


def _copy(files: Mapping[str, str], number: int) -> Iterator[Source]:
    names = sorted({name for text in files.values() for name in _DECLARED.findall(text)})
    declared = re.compile(rf"\b({'|'.join(names)})\b(?![\"/]|\.ttl)")
    for path, text in sorted(files.items()):
        if number and "\ntask " in text:
            continue
        renamed = re.sub(r'^import "(?:.*/)?(\w+)\.skill"', rf'import "\g<1>_{number}.skill"', text, flags=re.MULTILINE)
        targets = re.sub(r'"[^"\n]*"|#.*|\b\w+\b', lambda word: _renamed(declared, word.group(), number), renamed)
        stem = path.rpartition("/")[2].removesuffix(".skill")
        yield Source(f"{stem}_{number}.skill", targets, edition=NEWEST)


def _renamed(declared: re.Pattern[str], word: str, number: int) -> str:
    return f"{word}_{number}" if declared.fullmatch(word) else word


def main() -> None:
    """Print one line for each stage."""
    sources = generated(int(sys.argv[1]) if len(sys.argv) > 1 else 10_000)
    terms = load_vocabulary()
    parser = make_parser(grammar_text())
    lines = sum(source.text.count("\n") for source in sources)
    print(f"{lines} lines in {len(sources)} files")
    pairs = []
    for _ in range(ROUNDS):
        bare = _seconds(lambda: _parse(parser, sources))[0]
        seconds, outcome = _seconds(lambda: compile(sources, terms, {}, "generated"))
        pairs.append((bare, seconds))
    bare = median(bare for bare, _ in pairs)
    print(f"{'stage':28} {'seconds':>8} {'ratio':>6}")
    print(f"{'lark parse alone':28} {bare:8.2f} {1.0:6.2f}")
    for stage, seconds in _stages(sources):
        print(f"{stage:28} {seconds:8.2f} {seconds / bare:6.2f}")
    _print_pairs(f"{'whole':28}", pairs)
    print(f"\n{'process, beside one that imports click':45} {'seconds':>8} {'ratio':>6}")
    for name, pairs in _processes(sources):
        _print_pairs(f"{name:45}", pairs)
    for problem in outcome.diagnostics[:5]:
        print(f"{problem.span.path}:{problem.span.line}: {problem.name}: {problem.message}", file=sys.stderr)


def _print_pairs(name: str, pairs: Sequence[tuple[float, float]]) -> None:
    """Print the median seconds of what was measured, and of the ratios to what was measured right beside it."""
    seconds, ratio = median(long for _, long in pairs), median(long / short for short, long in pairs)
    print(f"{name} {seconds:8.2f} {ratio:6.2f}")


def _processes(sources: Sequence[Source]) -> Iterator[tuple[str, list[tuple[float, float]]]]:
    """Yield the processor seconds of checks of these sources as whole processes, each beside the least there can be."""
    with tempfile.TemporaryDirectory() as folder:
        library = Path(folder, "generated")
        library.mkdir()
        (library / "skillc.toml").write_text(MANIFEST, encoding="utf-8")
        for source in sources:
            (library / source.path).write_text(source.text, encoding="utf-8")
        os.environ["XDG_CACHE_HOME"] = str(Path(folder, "cache"))
        os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
        check = [sys.executable, "-c", "from skillc.cli.main import main; main()", "check", str(library)]
        shipped = [*check[:-1], "wiping"]
        bare = [sys.executable, "-c", "import click"]
        _process(check), _process(shipped)
        for name, command in (("the shipped library", shipped), ("these files", check)):
            yield f"check of {name}, unchanged", [(_process(bare), _process(command)) for _ in range(ROUNDS)]
        for name, edited in EDITS.items():
            source = next(each for each in sources if edited.search(each.text) and "_1." in each.path)
            pairs = [(_process(bare), seconds) for seconds in _after_edits(check, library / source.path, edited)]
            yield f"check of these files, {name} changed", pairs


def _after_edits(check: Sequence[str], file: Path, edited: re.Pattern[str]) -> Iterator[float]:
    """Yield the processor seconds of checks, each after another edit of a file, which is as before at the end."""
    text = file.read_text(encoding="utf-8")
    for number in range(ROUNDS):
        file.write_text(edited.sub(f"{number + 26} mm", text, count=1), encoding="utf-8")
        yield _process(check)
    file.write_text(text, encoding="utf-8")
    _process(check)


def _process(command: Sequence[str]) -> float:
    """Return the processor seconds that a process took."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, capture_output=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def _stages(sources: Sequence[Source]) -> Iterator[tuple[str, float]]:
    """Yield the seconds of each stage, one after the other, and of the checks that take longest."""
    seconds, files = _seconds(lambda: read_sources(sources, {}, "generated"))
    yield "read", seconds
    seconds, program = _seconds(lambda: resolve_program(files.value, load_vocabulary(), "generated", {}))
    yield "resolve", seconds
    proving, proofs = _seconds(lambda: prove(program.value, Prover(program.value)))
    found = [(proving, "prove")]
    for one in load_checks():
        python = NamedPython(program.value, Targets())
        of = {Reads.PROOFS: proofs, Reads.PYTHON: python}.get(one.READS, program.value)
        found.append((_seconds(lambda one=one, of=of: list(one.check(of)))[0], one.__name__))
    yield "check", sum(seconds for seconds, _ in found)
    for seconds, name in sorted(found, reverse=True)[:4]:
        yield f"  {name.rpartition('.')[2]}", seconds
    seconds, _ = _seconds(lambda: lower_program(program.value, ()))
    yield "lower", seconds


def _parse(parser: Lark, sources: Sequence[Source]) -> None:
    for source in sources:
        parser.parse(source.text)


def _seconds(work: Callable[[], Result]) -> tuple[float, Result]:
    """Return the processor time of a call, with its result."""
    start = process_time()
    result = work()
    return process_time() - start, result


if __name__ == "__main__":
    main()
