"""Skills, and what each does to a world: several worlds may come of a skill with outcomes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import product

from columns.effects import Effect
from columns.meaning import Condition, named, thing
from columns.worlds import FUNCTIONAL, STORED, Fact, World


@dataclass(frozen=True)
class Parameter:
    """`in`, or `infer` of what a functional relation of another parameter leads to."""

    name: str
    cls: str
    of: tuple[str, str] | None = None

    @property
    def lines(self) -> list[str]:
        if self.of is None:
            return [f"    in {self.name}: {self.cls}"]
        return [
            f"    infer {self.name}: {self.cls}",
            f"    pre found_{self.name}: {named(self.of[0])} {self.of[1]} {self.name}",
        ]


@dataclass(frozen=True)
class Outcome:
    """One of the things that may come of a skill, and how likely that is."""

    label: str
    effects: tuple[Effect, ...]
    likely: float | None = None


@dataclass(frozen=True)
class Skill:
    """A skill with its preconditions and effects."""

    name: str
    parameters: tuple[Parameter, ...]
    pre: tuple[Condition, ...]
    effects: tuple[Effect, ...]
    seconds: int
    uses: str | None = None
    senses: tuple[str, str] | None = None
    outcomes: tuple[Outcome, ...] = ()
    hold: tuple[Condition, ...] = ()

    @property
    def text(self) -> str:
        lines = [f"skill {self.name} {{", *(line for each in self.parameters for line in each.lines)]
        lines += [f"    pre p{number}: {each.text}" for number, each in enumerate(self.pre)]
        lines += [f"    hold h{number}: {each.text}" for number, each in enumerate(self.hold)]
        lines += [f"    post e{number}: {each.text}" for number, each in enumerate(self.effects)]
        lines += [f"    senses {'.'.join(self.senses)}"] if self.senses else []
        for each in self.outcomes:
            likely = "" if each.likely is None else f" likely {each.likely}"
            lines.append(f"    outcome {each.label}: {' and '.join(one.text for one in each.effects)}{likely}")
        lines += [f"    uses {named(self.uses)}"] if self.uses else []
        lines += [f"    duration {self.seconds} s", "}"]
        return "\n".join([*lines, f'impl one of {self.name} {{ run python "skillc.primitives:StandIn" }}'])

    def calls(self, world: World) -> Iterator[Mapping[str, str]]:
        """Yield every choice of things of the right classes."""
        names = [each.name for each in self.parameters]
        for chosen in product(*(world.members(each.cls) for each in self.parameters)):
            yield dict(zip(names, chosen, strict=True))

    def fits(self, world: World, names: Mapping[str, str]) -> bool:
        """Whether the things are of the right classes, and its preconditions hold of them."""
        return (
            all(names[each.name] in world.members(each.cls) for each in self.parameters)
            and all(
                world.value(thing(each.of[0], names), each.of[1]) == names[each.name]
                for each in self.parameters
                if each.of
            )
            and all(each.holds(world, names) for each in self.pre)
        )

    def after(self, world: World, names: Mapping[str, str], is_whole: bool = True) -> dict[str, World]:
        """Return what may come of it, by the label of the outcome; nothing where it cannot start or cannot be done.

        Without `is_whole`, where one of its effects undoes another one, so that it fails at its end.
        """
        if not self.fits(world, names) or not all(each.holds(world, names) for each in self.hold):
            return {}
        several = {each.label: each.effects for each in self.outcomes} or {"": ()}
        if self.senses and (known := world.value(names[self.senses[0]], self.senses[1])) is not None:
            several = {
                label: effects
                for label, effects in several.items()
                if (self.senses[1], names[self.senses[0]], known) in _new(effects, world, names)
            }
        ends = {label: _apply((*self.effects, *effects), world, names) for label, effects in several.items()}
        return {label: after for label, (after, whole) in ends.items() if after is not None and whole == is_whole}


def _new(effects: tuple[Effect, ...], world: World, names: Mapping[str, str]) -> set[Fact]:
    return {fact for each in effects for fact in each.changes(world, names)[1]}


def _apply(effects: tuple[Effect, ...], world: World, names: Mapping[str, str]) -> tuple[World | None, bool]:
    """Return the world with all effects, and whether each has come; no world if one cannot be done, or has no value."""
    if not all(each.allowed(world, names) for each in effects):
        return None, False
    gone: set[Fact] = set()
    new: set[Fact] = set()
    for each in effects:
        less, more = each.changes(world, names)
        gone, new = gone | less, new | more
    single = [(name, owner) for name, owner, _ in new if name not in STORED or name in FUNCTIONAL]
    if len(set(single)) < len(single):
        return None, False
    after = world.changed(gone, new)
    return after, all(each.came(after, world, names) for each in effects)
