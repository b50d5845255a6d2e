"""Goals given at run time, made in both forms or changed: what is understood means the same and can be decided."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from pathlib import Path
from random import Random

from fuzz.kinds._texts import make_text
from skillc.services.library import compiled_libraries
from skillc.services.library.files import SHIPPED, find_library
from skillc.services.tasks.individuals import classes_by_individual
from skillc_compiler.goals.parsing import parse_goal
from skillc_dsl.diagnostics import Outcome
from skillc_model.conditions import Condition
from skillc_model.skills import SkillLibrary
from skillc_model.traversal import free_variables
from skillc_ontology import catalogue
from skillc_rdf.vocabulary.types import PlainType
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.explain import explain
from skillc_runtime.world.state.world_state import WorldState

NOISE = (
    *(
        "",
        " ",
        "\n",
        "\r",
        "\0",
        "(",
        ")",
        "()",
        "((",
        "))",
        "not",
        "and",
        "or",
        "(not",
        "exists",
        "?x",
        "-",
        "=",
        "<",
        "_",
    ),
    *(
        "x: Product",
        "{",
        "}",
        "[",
        "]",
        '"',
        "1 kg",
        "3",
        "true",
        "λ",
        "😀",
        "\ud800",
        "\u2028",
        "#",
        ";",
        ":",
        "lab:",
        "Thing",
    ),
)
DEEP = ("(", "not ", "(not ", "(and ", "exists x: Thing (", "(exists (?x - Thing) ", "1 + ", "- ")


@dataclass(frozen=True)
class Lab:
    """A world to ask about, and what its goals can be made of."""

    library: SkillLibrary
    state: WorldState
    individuals: dict[str, list[str]]
    names: tuple[str, ...]
    relations: tuple[str, ...]
    flags: tuple[str, ...]
    classes: tuple[str, ...]


def run_case(random: Random, folder: Path) -> None:
    """Understand a goal; decide it, and compare its two forms, where it is understood."""
    lab = _lab(random.choice(("ur5e_whiteboard.ttl", "panda_desk.ttl", "two_robots.ttl")))
    own, pddl = _goal(random, lab, random.randrange(4), ())
    texts = [own, pddl]
    if random.random() < 0.6:
        texts = [_changed(random, random.choice(texts)) for _ in range(2)]
    (folder / "goal.txt").write_text("\n---\n".join(texts), encoding="utf-8", errors="surrogatepass", newline="")
    understood = [_understood(text, lab) for text in texts]
    if texts == [own, pddl]:
        one, other = understood
        assert (one is None) == (other is None), "one form is understood, and the other not"
        assert one is None or one == other or _alike(one, other, lab), f"the forms differ: {one} {other}"


def _understood(text: str, lab: Lab) -> Condition | None:
    outcome = parse_goal(text, lab.library.vocabulary, lab.individuals, lab.state.vocabulary.prefixes)
    _check_diagnostics(outcome, text)
    goal = outcome.value
    if goal is None:
        assert not outcome.ok, "refused without an error"
        return None
    assert not free_variables(goal), "a name stands for nothing"
    holds = evaluate(goal, lab.state, {})
    assert isinstance(holds, bool)
    assert holds or explain(goal, lab.state, {}, lab.state.vocabulary)
    return goal


def _check_diagnostics(outcome: Outcome[Condition | None], text: str) -> None:
    last = max(1, len(text.splitlines()))
    for each in outcome.diagnostics:
        assert each.name and each.message, each
        assert each.span.path == "goal" and 1 <= each.span.line <= each.span.end_line <= last, (each, last)
        assert each.span.column >= 1 and each.span.end_column >= 1, each


def _alike(one: Condition, other: Condition | None, lab: Lab) -> bool:
    return other is not None and evaluate(one, lab.state, {}) == evaluate(other, lab.state, {})


def _goal(random: Random, lab: Lab, depth: int, variables: tuple[str, ...]) -> tuple[str, str]:
    """Return a goal as the language and as PDDL say it."""
    if depth == 0:
        return _atom(random, lab, variables)
    match random.randrange(5):
        case 0:
            own, pddl = _goal(random, lab, depth - 1, variables)
            return f"not ({own})", f"(not {pddl})"
        case 1:
            kind, variable, cls = random.choice(("exists", "forall")), f"v{depth}", random.choice(lab.classes)
            own, pddl = _goal(random, lab, depth - 1, (*variables, variable))
            return f"{kind} {variable}: {cls} ({own})", f"({kind} (?{variable} - {cls}) {pddl})"
        case _:
            word = random.choice(("and", "or"))
            parts = [_goal(random, lab, depth - 1, variables) for _ in range(random.randrange(2, 4))]
            own = f" {word} ".join(f"({own})" for own, _ in parts)
            return own, f"({word} {' '.join(pddl for _, pddl in parts)})"


def _atom(random: Random, lab: Lab, variables: tuple[str, ...]) -> tuple[str, str]:
    one, other = (random.choice((*lab.names, *variables * 40)) for _ in range(2))
    marked = [f"?{each}" if each in variables else each for each in (one, other)]
    match random.randrange(4):
        case 0:
            cls = random.choice(lab.classes)
            return f"{one} is {cls}", f"({cls} {marked[0]})"
        case 1:
            flag = random.choice(lab.flags)
            return f"{one}.{flag} == true", f"({flag} {marked[0]})"
        case 2:
            return f"{one} == {other}", f"(= {marked[0]} {marked[1]})"
        case _:
            relation = random.choice(lab.relations)
            return f"{one} {relation} {other}", f"({relation} {marked[0]} {marked[1]})"


def _changed(random: Random, text: str) -> str:
    """Return a goal with words left out, doubled, exchanged or put in, or nested as deep as nobody would."""
    if random.random() < 0.05:
        return make_text(random)
    if random.random() < 0.05:
        deep, word = random.choice((10, 99, 101, 300, 3000)), random.choice(DEEP)
        return word * deep + text + ")" * (word.count("(") * deep)
    for _ in range(random.choice((1, 1, 2, 4))):
        words = text.replace("(", " ( ").replace(")", " ) ").split(" ")
        at = random.randrange(len(words))
        words[at] = random.choice(("", f"{words[at]} {words[at]}", random.choice(words), random.choice(NOISE)))
        text = " ".join(words)
    return text


@cache
def _library_of() -> SkillLibrary:
    return compiled_libraries.compile_valid(find_library(SHIPPED / "wiping"))


@cache
def _lab(scene: str) -> Lab:
    library = _library_of()
    vocabulary = library.vocabulary
    state = load_scene(catalogue.scene_path(scene), vocabulary)
    individuals = classes_by_individual(state, vocabulary)
    short = state.vocabulary.short
    flags = (iri for iri, term in vocabulary.properties.items() if term.type == PlainType("Bool"))
    return Lab(
        library,
        state,
        individuals,
        tuple(sorted(short(each) for each in individuals if short(each).startswith("lab:"))),
        tuple(sorted(map(short, vocabulary.relations))),
        tuple(sorted(map(short, flags))),
        ("Thing", *sorted(map(short, vocabulary.classes))),
    )
