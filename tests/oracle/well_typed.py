"""Checks the types of printed PDDL, which neither the `pddl` package nor Fast Downward does."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TypeAlias

Tree: TypeAlias = str | list["Tree"]

CONNECTIVES = ("and", "or", "not", "imply", "when", "increase")
TIMES = (["at", "start"], ["at", "end"], ["over", "all"])


@dataclass(frozen=True)
class Declared:
    """What a domain declares: a type's parent, the types of objects, and those of the arguments of a name."""

    parents: Mapping[str, str]
    objects: Mapping[str, str]
    arguments: Mapping[str, list[str]]

    def is_a(self, type_: str, wanted: str) -> bool:
        """Whether every object of a type is of another."""
        while type_ != wanted and type_ in self.parents:
            type_ = self.parents[type_]
        return type_ == wanted


def mistakes(domain: str, problem: str | None = None) -> list[str]:
    """Return what is undeclared, declared twice or of the wrong type in a domain and a problem of it."""
    whole = _sections(domain)
    parts = {} if problem is None else _sections(problem)
    objects = [*_typed(whole.get(":constants", [[]])[0]), *_typed(parts.get(":objects", [[]])[0])]
    names = [name for name, _ in objects]
    heads = [*whole.get(":predicates", [[]])[0], *whole.get(":functions", [[]])[0]]
    known = Declared(
        dict(_typed(whole[":types"][0])),
        dict(objects),
        {str(each[0]): [type_ for _, type_ in _typed(each[1:])] for each in heads if isinstance(each, list)},
    )
    found = [f"{name} is declared twice" for name in sorted(set(names)) if names.count(name) > 1]
    for action in (*whole.get(":action", []), *whole.get(":durative-action", [])):
        fields = dict(zip(action[1::2], action[2::2], strict=True))  # type: ignore[arg-type]
        scope = {**known.objects, **dict(_typed(fields.pop(":parameters")))}
        found += [f"{action[0]}: {each}" for field in fields.values() for each in _wrong(field, scope, known)]
    for section in (":init", ":goal"):
        found += [each for part in parts.get(section, [[]])[0] for each in _wrong(part, known.objects, known)]
    return found


def _wrong(tree: Tree, scope: Mapping[str, str], known: Declared) -> Iterator[str]:
    """Yield what is wrong with a formula or an effect."""
    if isinstance(tree, str) or not tree:
        return
    head, *rest = tree
    if head in ("forall", "exists"):
        yield from _wrong(rest[1], {**scope, **dict(_typed(rest[0]))}, known)
    elif head in CONNECTIVES:
        yield from (each for part in rest for each in _wrong(part, scope, known))
    elif tree[:2] in TIMES:
        yield from _wrong(rest[1], scope, known)
    elif head == "=":
        yield from (each for part in rest if isinstance(part, list) for each in _wrong(part, scope, known))
        named = (part for part in rest if isinstance(part, str) and not part[0].isdigit() and part != "?duration")
        yield from (f"{each} is undeclared" for each in named if each not in scope)
    else:
        yield from _wrong_arguments(str(head), [str(each) for each in rest], scope, known)


def _wrong_arguments(head: str, terms: list[str], scope: Mapping[str, str], known: Declared) -> Iterator[str]:
    wanted = known.arguments.get(head)
    if wanted is None or len(wanted) != len(terms):
        yield f"{head} is undeclared with {len(terms)} arguments"
        return
    for name, type_ in zip(terms, wanted, strict=True):
        if name not in scope:
            yield f"{name} is undeclared"
        elif not known.is_a(scope[name], type_):
            yield f"({head} {' '.join(terms)}): {name} is a {scope[name]}, no {type_}"


def _sections(text: str) -> dict[str, list[list[Tree]]]:
    """Return the sections of a file by their names; of actions there are several."""
    tokens = re.findall(r"[()]|[^\s()]+", re.sub(r";[^\n]*", "", text))
    (tree,) = _read(iter(tokens))
    found: dict[str, list[list[Tree]]] = {}
    for each in tree[2:]:
        assert isinstance(each, list)
        found.setdefault(str(each[0]), []).append(each[1:])
    return found


def _read(tokens: Iterator[str]) -> list[Tree]:
    found: list[Tree] = []
    for token in tokens:
        if token == ")":
            return found
        found.append(_read(tokens) if token == "(" else token)
    return found


def _typed(trees: Tree) -> list[tuple[str, str]]:
    """Return names with their types, `a b - t`."""
    found: list[tuple[str, str]] = []
    waiting: list[str] = []
    words = iter(trees)
    for word in words:
        if word == "-":
            type_ = str(next(words))
            found += [(name, type_) for name in waiting]
            waiting = []
        elif isinstance(word, str):
            waiting.append(word)
    return [*found, *((name, "object") for name in waiting)]
