"""Whoever follows the remedies of `undeclared-effect` comes to an end, where the check accepts what was added.

So does whoever copies a value of an enumeration from one property to another. The bodies are those of random compounds,
of the pairs and of libraries, without their posts. `SKILLC_REMEDIES` is the number of random libraries with three
compounds each.
"""

from __future__ import annotations

import os
import re
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from random import Random

import pytest
from shipped import library, shelf, vocabulary

from analysis.plays import Writer
from skillc_compiler.pipeline import compile
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Source

PAIRS, LIBRARIES = Path(__file__).parent / "pairs", Path(__file__).parent.parent / "cases" / "libraries"
RANDOM = int(os.environ.get("SKILLC_REMEDIES", "6"))
MOST_ROUNDS = 25
POST = re.compile(r"^ *post (?!sensed).*\n", re.MULTILINE)
ADDED = ("post-not-established", "contradicting-posts", "two-values", "post-not-literal", "syntax", "undeclared-effect")
"""What would be wrong with lines that a remedy adds, and what they have to cure."""


def told(sources: Sequence[Source]) -> list[Diagnostic]:
    """Return the problems of sources, the standard library aside."""
    found = compile(sources, vocabulary(), shelf(), "own").diagnostics
    return [each for each in found if not each.span.path.startswith("std/")]


def without_posts(text: str) -> str:
    """Return a text without the posts of the skills with a body of steps, and of these bodies."""
    parts = re.split(r"^(?=(?:## |skill |impl |class |task |test ))", text, flags=re.MULTILINE)
    bodies = {name for part in parts for name in re.findall(r"^impl \w+ of (\w+) \{", part) if " do " in part}
    heads = (re.match(r"skill (\w+)|impl \w+ of (\w+)", part) for part in parts)
    names = [next((each for each in head.groups() if each), "") if head else "" for head in heads]
    return "".join(POST.sub("", part) if name in bodies else part for part, name in zip(parts, names, strict=True))


def cure(problem: Diagnostic, text: str) -> str:
    """Return a text with what the help of a problem says: its lines, and what is passed to calls."""
    assert problem.help is not None
    said = re.match(
        r"add (.*?) to `(\w+)`(?: or to this implementation)?(?:, and pass (.*?) to (.*?))?, or undo it", problem.help
    )
    assert said is not None, problem
    lines, skill, passed, called = said.groups()
    head = text.index(f"skill {skill} {{")
    end = text.index("}\n", head)
    added = "".join(f"    {line}\n" for line in re.findall(r"`([^`]*)`", lines))
    text = text[:end] + ("" if text[:end].endswith("\n") else "\n") + added + text[end:]
    for name in re.findall(r"\w+", called or ""):
        has = re.search(rf"skill {name} {{(.*?)\n?}}\n", text, re.DOTALL)
        own = [each for each in re.findall(r"\w+", passed or "") if has and f" {each}:" in has.group(1)]
        more = "".join(f"{each}: {each}, " for each in own)
        body = text.index(f" of {skill} {{")
        text = text[:body] + re.sub(rf"\b{name}\((?!{re.escape(more)})", f"{name}({more}", text[body:], count=1)
    return text


def follow(sources: Sequence[Source]) -> tuple[list[Source], list[Diagnostic]]:
    """Return sources with all remedies, and what is then told of them."""
    found = told(sources)
    for _ in range(MOST_ROUNDS):
        undeclared = [each for each in found if each.name == "undeclared-effect"]
        if not undeclared:
            break
        (first, *_), texts = undeclared, {each.path: each.text for each in sources}
        texts[first.span.path] = cure(first, texts[first.span.path])
        sources = [each._replace(text=texts[each.path]) for each in sources]
        found = told(sources)
    return list(sources), found


def check(sources: Sequence[Source]) -> int:
    """Follow the remedies, and return how many effects were not declared before."""
    before = Counter(each.name for each in told(sources))
    after, found = follow(sources)
    wrong = [each for each in found if each.name in ADDED]
    counts = Counter(each.name for each in wrong)
    assert all(counts[name] <= before[name] for name in counts if name != "undeclared-effect"), (wrong, after)
    assert not counts["undeclared-effect"], ([each for each in wrong if each.name == "undeclared-effect"], after)
    return before["undeclared-effect"]


def pair(kind: str) -> list[Source]:
    """Return the right compounds of a kind: a wrong one has other effects than the one that has its skill too."""
    text = re.sub(r"^impl wrong of .*?^}\n", "", (PAIRS / f"{kind}.skill").read_text(), flags=re.MULTILINE | re.DOTALL)
    return [Source("things.skill", (PAIRS / "things.skill").read_text()), Source(f"{kind}.skill", without_posts(text))]


def of_library(name: str) -> list[Source]:
    """Return a library of the tests, or one that ships."""
    path = LIBRARIES / f"{name}.skill"
    sources = [Source(path.name, path.read_text())] if path.exists() else library(name)
    return [each._replace(text=without_posts(each.text)) for each in sources]


def test_remedies_of_a_library_are_accepted() -> None:
    assert check(of_library("kitchen")) == 2


@pytest.mark.slow
@pytest.mark.parametrize("name", [*sorted(path.stem for path in LIBRARIES.glob("*.skill")), "contact", "sorting"])
def test_remedies_of_all_libraries_are_accepted(name: str) -> None:
    check(of_library(name))


@pytest.mark.slow
@pytest.mark.parametrize("kind", sorted(path.stem for path in PAIRS.glob("*.skill") if path.stem != "things"))
def test_remedies_of_the_pairs_are_accepted(kind: str) -> None:
    check(pair(kind))


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(RANDOM))
def test_remedies_of_random_compounds_are_accepted(seed: int) -> None:
    check([Source("random.skill", without_posts(Writer(Random(seed)).library()))])


COPY = """\
use skiros

enum     Quality { Sound, Sour }
class    Tank < Location
property quality(Tank): Quality
property taste(Tank): Quality

skill Copy {
    in   tank: Tank
    post tank.taste := tank.quality
}

skill CopyIfKnown {
    in   tank: Tank
    post forall q: Quality (tank.taste == q when tank.quality == q)
}
"""


def test_a_value_of_an_enumeration_is_copied_as_the_remedies_say() -> None:
    text, said = COPY, []
    while errors := [each for each in told([Source("own.skill", text)]) if each.severity == "error"]:
        (error,) = errors
        said.append(error.name)
        wrong = text.split("\n")[error.span.line - 1]
        head, line, end = text.partition(wrong)
        added = re.fullmatch(r"add `(.*)` and `(.*)`, and write `(\w+)` here", error.help or "")
        if added:
            line = "\n".join((f"    {added[1]}", f"    {added[2]}", line.replace("tank.quality", added[3])))
        else:
            assert error.help == "say what is so afterwards with `==`"
            line = line.replace(":=", "==")
        text = head + line + end
    assert said == ["wrong-operands", "post-not-literal"]
    assert {each.name for each in told([Source("own.skill", text)])} == {"no-implementation"}
