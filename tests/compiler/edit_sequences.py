"""An author at work: random edits of a library, files that come and go, other terms and scenes; repeatable by seed."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from functools import cache

import msgspec
from shipped import library, shelf, vocabulary
from single_edits import apply_edits, single_edit
from test_libraries import LIBRARIES, text_of

from skillc_compiler.ide.analysis import AnalysisInput
from skillc_dsl.source import Source
from skillc_rdf.vocabulary.types import Vocabulary

STEPS = 12


@cache
def beginnings() -> tuple[Mapping[str, Source], ...]:
    """Return the libraries to begin with: the shipped ones as one library, and those of other authors."""
    standard = [Source(name, source.text) for name, source in shelf().items()]
    shipped = [*standard, *library("wiping")]
    others = [[Source("m.skill", text_of(path.stem))] for path in LIBRARIES]
    return tuple({each.path: each for each in sources} for sources in (shipped, shipped[-4:], *others))


def edited_libraries(seed: int) -> Iterator[AnalysisInput]:
    """Yield the states of a library between the edits of a random sequence."""
    chance = random.Random(seed)
    now = AnalysisInput("mine", dict(chance.choice(beginnings())), shelf(), vocabulary())
    yield now
    for _ in range(STEPS):
        now = chance.choices(list(_STEPS), list(_STEPS.values()))[0](now, chance)
        yield now


def _write(now: AnalysisInput, path: str, text: str) -> AnalysisInput:
    return replace(now, sources={**now.sources, path: Source(path, text)})


def _edit(now: AnalysisInput, chance: random.Random) -> AnalysisInput:
    """Make a mistake, or a change, somewhere."""
    path = chance.choice(sorted(now.sources))
    text = now.sources[path].text
    try:
        return _write(now, path, apply_edits(text, [single_edit(text, chance.randrange(10**6))]))
    except IndexError:  # a text without anything to edit
        return now


def _correct(now: AnalysisInput, chance: random.Random) -> AnalysisInput:
    """Write a file as it was at the beginning."""
    files = [source for each in beginnings() for source in each.values() if source.path in now.sources]
    source = chance.choice(files or list(shelf().values()))
    return _write(now, source.path, source.text)


def _insert_line(now: AnalysisInput, chance: random.Random) -> AnalysisInput:
    """Move everything below a line."""
    path = chance.choice(sorted(now.sources))
    lines = now.sources[path].text.split("\n")
    lines.insert(chance.randrange(len(lines)), chance.choice(["", "# a comment"]))
    return _write(now, path, "\n".join(lines))


def _change_header(now: AnalysisInput, chance: random.Random) -> AnalysisInput:
    """Remove, repeat or move a line `use`, `import` or `prefix`, take a vocabulary from one, or add one."""
    path = chance.choice(sorted(now.sources))
    lines = now.sources[path].text.split("\n")
    header = [number for number, line in enumerate(lines) if line.startswith(("use ", "import ", "prefix "))]
    others = [f'import "{other}"' for other in (*now.sources, *now.importable) if other != path]
    if not header or chance.random() < 0.3:
        vocabulary = chance.choice(sorted(now.vocabulary.prefixes))
        lines.insert(header[-1] + 1 if header else 0, chance.choice([*others, f"use {vocabulary}"]))
        return _write(now, path, "\n".join(lines))
    here = chance.choice(header)
    match chance.randrange(4):
        case 0:
            del lines[here]
        case 1:
            lines.insert(here, lines[here])
        case 2:
            lines.append(lines.pop(here))
        case _:
            lines[here] = lines[here].rpartition(",")[0] or lines[here].partition(" ")[0]
    return _write(now, path, "\n".join(lines))


def _add(now: AnalysisInput, chance: random.Random) -> AnalysisInput:
    """Add a file, or a copy of one, whose declarations then exist twice."""
    files = [source for each in beginnings() for source in each.values()]
    source = chance.choice(
        [*files, Source("new.skill", "skill New {\n    in thing: Thing\n    post thing is Thing\n}\n")]
    )
    return _write(now, f"{chance.choice('abc')}_{source.path}" if chance.random() < 0.3 else source.path, source.text)


def _remove(now: AnalysisInput, chance: random.Random) -> AnalysisInput:
    gone = chance.choice(sorted(now.sources))
    rest = {path: source for path, source in now.sources.items() if path != gone}
    return replace(now, sources=rest) if rest else now


def _rename(now: AnalysisInput, chance: random.Random) -> AnalysisInput:
    old = chance.choice(sorted(now.sources))
    text = now.sources[old].text
    return _write(_remove_path(now, old), f"{chance.choice('az')}{old}", text)


def _remove_path(now: AnalysisInput, path: str) -> AnalysisInput:
    return replace(now, sources={other: source for other, source in now.sources.items() if other != path})


def _change_terms(now: AnalysisInput, chance: random.Random) -> AnalysisInput:
    """Take a term from the vocabulary, or change an axiom of one."""
    terms: Vocabulary = vocabulary()
    iri = chance.choice(sorted(terms.relations))
    toggled = msgspec.structs.replace(terms.relations[iri], functional=not terms.relations[iri].functional)
    changed: list[Vocabulary] = [
        terms,
        msgspec.structs.replace(terms, relations={**terms.relations, iri: toggled}),
        msgspec.structs.replace(terms, relations={key: one for key, one in terms.relations.items() if key != iri}),
        msgspec.structs.replace(terms, properties=dict(list(terms.properties.items())[chance.randrange(5) :])),
    ]
    return replace(now, vocabulary=chance.choice(changed))


def _change_scenes(now: AnalysisInput, chance: random.Random) -> AnalysisInput:
    """Give the tasks other individuals, or none."""
    words = {word.strip("(),.") for source in now.sources.values() for word in source.text.split() if ":" in word}
    named = sorted(word for word in words if not word.endswith(":"))
    classes = sorted(now.vocabulary.classes)
    some = chance.sample(named, min(len(named), 3))
    iris = [_iri(now.vocabulary, word) for word in some]
    scene = {iri: [chance.choice(classes)] for iri in iris}
    tasks = [line.split()[1] for source in now.sources.values() for line in source.text.split("\n") if _is_task(line)]
    return replace(now, scenes={task: scene for task in tasks if chance.random() < 0.7})


def _iri(terms: Vocabulary, word: str) -> str:
    prefix, _, local = word.partition(":")
    return terms.prefixes.get(prefix, "http://example.org/") + local


def _is_task(line: str) -> bool:
    return line.startswith("task ") and len(line.split()) > 1


_STEPS: Mapping[Callable[[AnalysisInput, random.Random], AnalysisInput], int] = {
    _edit: 10,
    _correct: 5,
    _insert_line: 2,
    _change_header: 3,
    _add: 2,
    _remove: 1,
    _rename: 1,
    _change_terms: 1,
    _change_scenes: 1,
}
