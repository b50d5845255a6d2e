"""Writes the effects of actions: what is so afterwards, to which of many things, at which cost."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

from skillc.services.pddl_import.conditions import ATOM, NOT, PRODUCT, VALUE, Scope, Text, Writer
from skillc.services.pddl_import.declarations import Typed
from skillc.services.pddl_import.expressions import BrokenPddl, Findings, Missing, Node, refuse
from skillc.services.pddl_import.ranges import CHANGES
from skillc.services.pddl_import.reading import read_variables
from skillc.services.pddl_import.terms import Defined, Entry, Property, Relation


@dataclass(frozen=True, slots=True)
class Literal:
    """An atom that becomes true or false: of all values of some variables, of which a condition holds, or of one."""

    node: Node
    positive: bool
    scope: Scope
    variables: tuple[tuple[str, Typed], ...] = ()
    when: tuple[Node, ...] = ()
    at_start: bool = False


@dataclass(slots=True)
class Effects:
    """The effects of an action: literals, changes of numbers, costs, and comments for what the language cannot say."""

    literals: list[Literal] = field(default_factory=list)
    changes: list[Literal] = field(default_factory=list)
    costs: list[Node] = field(default_factory=list)
    comments: list[str] = field(default_factory=list)


def read_effects(node: Node | None, scope: Scope, writer: Writer, findings: Findings) -> Effects:
    """Return the effects of an action."""
    effects = Effects()
    if node is not None and (node.word or node.items):
        _Reader(writer, findings, effects).read(Literal(node, True, scope))
    return effects


@dataclass(frozen=True, slots=True)
class _Reader:
    """Walks through an effect; what it is within stands in the literal that it passes on."""

    writer: Writer
    findings: Findings
    effects: Effects

    def read(self, found: Literal) -> None:
        """Note the literals of an effect."""
        try:
            self._read(found)
        except Missing as missing:
            self.effects.comments.append(self.findings.add_missing(missing))
        except BrokenPddl as error:
            self.findings.add_error(error)

    def _read(self, found: Literal) -> None:
        node = found.node
        match node.head:
            case "and":
                for each in node.rest:
                    self.read(replace(found, node=each))
            case "forall" if len(node.items) == 3:
                scope, made = found.scope.inner(read_variables(node.items[1], self.writer.terms.domain))
                self.read(replace(found, node=node.items[2], scope=scope, variables=found.variables + made))
            case "when" if len(node.items) == 3:
                self.read(replace(found, node=node.items[2], when=(*found.when, _without_time(node.items[1]))))
            case "not" if len(node.items) == 2:
                self._note(replace(found, node=node.items[1], positive=False))
            case "at" if len(node.items) == 3 and node.items[1].word in ("start", "end") and node.items[2].is_list:
                self.read(replace(found, node=node.items[2], at_start=node.items[1].word == "start"))
            case word if word in CHANGES and len(node.items) == 3:
                self._note_number(found)
            case "oneof" | "probabilistic" as word:
                raise Missing(node, f"`{word}` is not in the library: an effect is certain here")
            case _:
                self._note(found)

    def _note_number(self, found: Literal) -> None:
        what = found.node.items[1]
        if (what.head or what.word) != self.writer.terms.domain.cost:
            self.effects.changes.append(found)
        elif found.node.head != "increase":
            raise Missing(found.node, "a cost only increases")
        elif found.variables or found.when:
            raise Missing(found.node, "a cost that depends on a condition is not in the library")
        else:
            self.effects.costs.append(found.node.items[2])

    def _note(self, found: Literal) -> None:
        form, symbol = self.writer.form(found.node)
        if isinstance(form, Defined):
            refuse(found.node, f"`{symbol.node.written}` is derived: no action changes it")
        self.writer.arguments(found.node, symbol, found.scope)
        self.effects.literals.append(found)


def write_posts(effects: Effects, writer: Writer, findings: Findings) -> Iterator[str]:
    """Yield the postconditions, of what the effects add together: what is deleted and added is added."""
    added = {str(each.node) for each in effects.literals if each.positive and not each.variables and not each.when}
    literals = [each for each in effects.literals if each.positive or each.when or str(each.node) not in added]
    groups: dict[tuple[object, ...], list[str]] = {}
    results: list[Literal | tuple[Literal, ...]] = [*literals, *_group_changes(effects.changes)]
    for each in results:
        try:
            key, text = _write_changes(each, writer) if isinstance(each, tuple) else _write(each, writer)
        except Missing as missing:
            yield findings.add_missing(missing)
            continue
        if key:
            groups.setdefault(key, []).append(text)
        else:
            yield text
    for (name, cls, when), texts in groups.items():
        yield f"forall {name}: {cls} ({' and '.join(dict.fromkeys(texts))}{f' when {when}' if when else ''})"


def _write(found: Literal, writer: Writer) -> tuple[tuple[object, ...], str]:
    """Return a literal, and what it is for: variable, class and condition; nothing for what is done to one thing."""
    form, symbol = writer.form(found.node)
    plain = not found.variables and not found.when
    arguments = writer.arguments(found.node, symbol, found.scope)
    conditions = [writer.condition(each, _inner(found.scope)) for node in found.when for each in writer.conjuncts(node)]
    if isinstance(form, Entry):
        if plain:
            entry = writer.entry(form, arguments, found.scope)
            return (), f"{entry}.{form.value} == {_bool(found)}"
        name = found.scope.names.give("entry")
        conditions += [Text(f"{name} {side} {each}", ATOM) for side, each in zip(form.sides, arguments, strict=True)]
        return (name, form.cls, _when(found.variables, conditions, writer)), f"{name}.{form.value} == {_bool(found)}"
    if plain:
        return (), _literal(form, arguments, found, writer)
    own = [each for each in found.variables if each[0] in arguments]
    if len(own) > 1:
        raise Missing(
            found.node, f"an effect on all pairs is not in the library: `{found.node}` has two variables of `forall`"
        )
    others = tuple(each for each in found.variables if each not in own)
    if own:
        name, typed = own[0]
        return (name, writer.terms.class_of(typed.types), _when(others, conditions, writer)), _literal(
            form, arguments, found, writer
        )
    return _one_of_many(found, form, arguments, conditions, writer)


def _group_changes(changes: list[Literal]) -> list[tuple[Literal, ...]]:
    """Return the changes, those of the same number together."""
    groups: dict[object, list[Literal]] = {}
    for each in changes:
        groups.setdefault(str(each.node.items[1]) if not each.variables and not each.when else id(each), []).append(
            each
        )
    return [tuple(each) for each in groups.values()]


def _write_changes(found: tuple[Literal, ...], writer: Writer) -> tuple[tuple[object, ...], str]:
    """Return what becomes of a number, and what it is for, as of a literal; several changes of it add up."""
    first, *others = found
    if not others:
        return _write_change(first, writer)
    amounts = [each.node.items[2] for each in found]
    kinds = {each.node.head for each in found}
    if not kinds <= {"increase", "decrease"}:
        raise Missing(first.node, f"`{first.node.items[1]}` changes twice, in ways that do not add up")
    if len(found) == 2 and len(kinds) == 2 and str(amounts[0]) == str(amounts[1]):
        what = f"`{first.node.items[1]}` is the same at the end: how it changes meanwhile keeps nothing waiting"
        raise Missing(first.node, what)
    texts = [writer.number(each, first.scope).within(PRODUCT) for each in amounts]
    signs = ["+" if each.node.head == first.node.head else "-" for each in others]
    key, text = _write_change(first, writer)
    return key, text + "".join(f" {sign} {each}" for sign, each in zip(signs, texts[1:], strict=True))


def _write_change(found: Literal, writer: Writer) -> tuple[tuple[object, ...], str]:
    """Return a change of a number, and what it is for, as of a literal."""
    what, operator = found.node.items[1], CHANGES[found.node.head]
    form, arguments = writer.function(what, found.scope)
    plain = not found.variables and not found.when
    if isinstance(form, Entry):
        if not plain:
            raise Missing(found.node, f"a change of `{what}` under a condition is not in the library")
        owner, name = writer.entry(form, arguments, found.scope) or "", form.value
    else:
        owner, name = arguments[0] if arguments else writer.terms.world(), form.name
    scope = found.scope if plain else _inner(found.scope)
    conditions = [writer.condition(each, scope) for node in found.when for each in writer.conjuncts(node)]
    key: tuple[object, ...] = ()
    if not plain:
        own = [each for each in found.variables if each[0] == owner]
        cls = writer.terms.class_of(form.symbol.parameters[0].types) if arguments else writer.terms.world_class
        if not own:
            each_one = found.scope.names.give("each")
            conditions.insert(0, Text(f"{each_one} == {owner}", ATOM))
            owner = each_one
        others = tuple(each for each in found.variables if each not in own)
        key = (owner, writer.terms.class_of(own[0][1].types) if own else cls, _when(others, conditions, writer))
    amount = writer.number(found.node.items[2], scope)
    value = f"{owner}.{name}"
    if operator in "*/":
        return key, f"{value} := {value} {operator} {amount.within(VALUE)}"
    return key, f"{value} {operator} {amount.text}"


def _one_of_many(
    found: Literal,
    form: Property | Relation | Defined,
    arguments: tuple[str, ...],
    conditions: list[Text],
    writer: Writer,
) -> tuple[tuple[object, ...], str]:
    """Return a conditional effect on one thing as one on all that are this thing."""
    name = found.scope.names.give("each")
    first = arguments[0] if arguments else writer.terms.world()
    cls = writer.terms.class_of(form.symbol.parameters[0].types) if arguments else writer.terms.world_class
    conditions = [Text(f"{name} == {first}", ATOM), *conditions]
    text = _literal(form, (name, *arguments[1:]), found, writer)
    return (name, cls, _when(found.variables, conditions, writer)), text


def _when(variables: tuple[tuple[str, Typed], ...], conditions: list[Text], writer: Writer) -> str:
    text = " and ".join(each.within(NOT) if len(conditions) > 1 else each.text for each in conditions)
    for name, typed in reversed(variables):
        text = f"exists {name}: {writer.terms.class_of(typed.types)} ({text})"
    return text


def _literal(form: Property | Relation | Defined, arguments: tuple[str, ...], found: Literal, writer: Writer) -> str:
    if isinstance(form, Property):
        return f"{arguments[0] if arguments else writer.terms.world()}.{form.name} == {_bool(found)}"
    return f"{'' if found.positive else 'not '}{arguments[0]} {form.name} {arguments[1]}"


def _without_time(node: Node) -> Node:
    """Return the condition of a conditional effect without its time: it is read when a skill starts."""
    if node.head == "and":
        return replace(node, items=(node.items[0], *map(_without_time, node.rest)))
    timed = len(node.items) == 3 and node.items[1].word in ("start", "end", "all") and node.items[2].is_list
    return node.items[2] if timed and node.head in ("at", "over") else node


def _inner(scope: Scope) -> Scope:
    return Scope(scope.variables, scope.names, None)


def _bool(found: Literal) -> str:
    return "true" if found.positive else "false"
