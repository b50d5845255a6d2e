"""Reads the declarations of domains and problems; each broken one is an error of its own."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from skillc.services.pddl_import.declarations import OBJECT, Action, Derived, Domain, Problem, Symbol, Typed
from skillc.services.pddl_import.expressions import BrokenPddl, Findings, Missing, Node, parse_expressions, refuse
from skillc_dsl.source import Source, Span
from skillc_dsl.spelling import did_you_mean

_SECTIONS = (":requirements", ":types", ":constants", ":predicates", ":functions", ":action", ":durative-action")
_PARTS = (":objects", ":init", ":goal", ":metric", ":domain", ":requirements")
_UNSAID = {
    ":constraints": "constraints on the way to the goal are not in the library: only its end counts",
    ":process": "a process, which changes numbers while time passes, cannot be said",
    ":event": "an event, which happens by itself, cannot be said",
}


def read_domain(source: Source, findings: Findings) -> Domain:
    """Return the domain of a file; BrokenPddl if it has none, other errors are noted."""
    define = _read_define(source, "domain")
    domain = Domain(define.items[1].items[1])
    domain.types[OBJECT], domain.written[OBJECT] = (), OBJECT
    sections = define.items[2:]
    order = {":types": 0, ":constants": 1, ":predicates": 1, ":functions": 1}
    for section in sorted(sections, key=lambda each: order.get(each.head, 2)):
        try:
            _read_section(section, domain)
        except BrokenPddl as error:
            if section.head == ":types":
                raise
            findings.add_error(error)
        except Missing as missing:
            findings.add_missing(missing)
    return domain


def read_problem(source: Source, domain: Domain, findings: Findings) -> Problem:
    """Return the problem of a file; BrokenPddl if it has none, other errors are noted."""
    define = _read_define(source, "problem")
    problem = Problem(define.items[1].items[1])
    for part in define.items[2:]:
        try:
            _read_part(part, problem, domain)
        except BrokenPddl as error:
            findings.add_error(error)
        except Missing as missing:
            findings.add_missing(missing)
    return problem


def _read_define(source: Source, kind: str) -> Node:
    found = parse_expressions(source)
    for each in found:
        if each.head == "define" and len(each.items) > 1 and each.items[1].head in ("domain", "problem"):
            other = each.items[1]
            if other.head != kind:
                refuse(other, f"this is a {other.head}, and a {kind} is expected here", "give the domain first")
            if len(other.items) != 2 or other.items[1].is_list:
                refuse(other, f"the {kind} has no name", f"write `({kind} NAME)`")
            return each
    place = found[0] if found else Node(Span(source.path, 1, 1, 1, 2))
    return refuse(place, f"there is no `(define ({kind} NAME) ...)`", f"is it a {kind} in PDDL?")


def _read_section(section: Node, domain: Domain) -> None:
    match section.head:
        case ":requirements":
            pass
        case ":types":
            _read_types(section, domain)
        case ":constants":
            domain.constants += read_typed(section.rest, domain)
        case ":predicates":
            domain.predicates |= {each.name: each for each in _read_symbols(section.rest, domain, domain.predicates)}
        case ":functions":
            _read_functions(section, domain)
        case ":action" | ":durative-action":
            domain.actions.append(_read_action(section, domain))
        case ":derived":
            domain.derived.append(_read_derived(section, domain))
        case head if head in _UNSAID:
            raise Missing(section, _UNSAID[head])
        case _:
            refuse(section, f"{_shown(section)} is no section of a domain", did_you_mean(section.head, _SECTIONS))


def _read_part(part: Node, problem: Problem, domain: Domain) -> None:
    match part.head:
        case ":domain":
            name = part.items[1].word if len(part.items) == 2 else ""
            if name != domain.name.word:
                refuse(part, f"this problem is one of the domain `{name}`, and that is called `{domain.name.written}`")
        case ":requirements" | ":length":
            pass
        case ":objects":
            problem.objects += read_typed(part.rest, domain)
        case ":init":
            problem.init = part.rest
        case ":goal":
            problem.goal = _only(part)
        case ":metric":
            if len(part.items) != 3 or part.items[1].word not in ("minimize", "maximize"):
                refuse(part, "a metric is `(:metric minimize EXPRESSION)`")
            problem.metric = part
        case head if head in _UNSAID:
            raise Missing(part, _UNSAID[head])
        case _:
            refuse(part, f"{_shown(part)} is no part of a problem", did_you_mean(part.head, _PARTS))


def _shown(node: Node) -> str:
    return f"`{node.head}`" if node.head else "this"


def _only(part: Node) -> Node:
    if len(part.items) != 2:
        refuse(part, f"one condition is expected after `{part.head}`")
    return part.items[1]


def _read_types(section: Node, domain: Domain) -> None:
    for node, above in _typed_list(section.rest):
        domain.types[node.word] = tuple(
            dict.fromkeys((*domain.types.get(node.word, ()), *(each.word for each in above)))
        )
        domain.written.setdefault(node.word, node.written)
        for each in above:
            domain.types.setdefault(each.word, ())
            domain.written.setdefault(each.word, each.written)
        if any(each.word != OBJECT and domain.is_a(each.word, node.word) for each in above):
            refuse(node, f"the type `{node.written}` is above itself")


def _typed_list(nodes: Sequence[Node]) -> Iterator[tuple[Node, tuple[Node, ...]]]:
    """Yield each name of a list such as `a b - t c`, with its types; none if none is stated."""
    names: list[Node] = []
    rest = iter(nodes)
    for node in rest:
        if node.is_list:
            refuse(node, f"a name is expected here, not `{node}`")
        if node.word != "-":
            names.append(node)
            continue
        kind = next(rest, None)
        if kind is None:
            refuse(node, "no type follows this `-`")
        types = kind.rest if kind.head == "either" else (kind,)
        if not types or any(each.is_list for each in types):
            refuse(kind, f"`{kind}` is no type", "write a name, or `(either NAME ..)`")
        yield from ((each, types) for each in names)
        names.clear()
    yield from ((each, ()) for each in names)


def read_typed(nodes: Sequence[Node], domain: Domain) -> tuple[Typed, ...]:
    """Return the names of a list with their types; BrokenPddl for an unknown type or a name that occurs twice."""
    found: dict[str, Typed] = {}
    for node, types in _typed_list(nodes):
        for each in types:
            if each.word not in domain.types:
                refuse(each, f"there is no type `{each.written}`", did_you_mean(each.word, domain.types))
        made = Typed(node, tuple(each.word for each in types) or (OBJECT,))
        if made.name in found:
            refuse(node, f"`{node.written}` is declared twice")
        found[made.name] = made
    return tuple(found.values())


def read_variables(node: Node, domain: Domain) -> tuple[Typed, ...]:
    """Return the variables of a list in parentheses."""
    if not node.is_list:
        refuse(node, f"variables in parentheses are expected here, not `{node}`")
    found = read_typed(node.items, domain)
    for each in found:
        if not each.node.word.startswith("?"):
            refuse(each.node, f"a variable begins with `?`: `?{each.written}`")
    return found


def _read_symbols(nodes: Iterable[Node], domain: Domain, known: Mapping[str, Symbol]) -> Iterator[Symbol]:
    seen = set(known)
    for node in nodes:
        if not node.head:
            refuse(node, f"a name with its parameters in parentheses is expected here, not `{node}`")
        if node.head in seen:
            refuse(node, f"`{node.items[0].written}` is declared twice")
        seen.add(node.head)
        yield Symbol(node.items[0], read_variables(Node(node.span, items=node.rest), domain))


def _read_functions(section: Node, domain: Domain) -> None:
    """Note the functions with numbers; Missing if others have objects as values."""
    lists: list[Node] = []
    objects: list[Node] = []
    rest = iter(section.rest)
    waiting: list[Node] = []
    for node in rest:
        if node.word != "-":
            waiting.append(node)
            continue
        kind = next(rest, None)
        (lists if kind is not None and kind.word == "number" else objects).extend(waiting)
        waiting = []
    domain.functions |= {each.name: each for each in _read_symbols((*lists, *waiting), domain, domain.functions)}
    domain.object_functions.update(each.head for each in objects)
    if objects:
        raise Missing(objects[0], "a function whose value is an object is not in the library, nor what reads it")


def _read_action(section: Node, domain: Domain) -> Action:
    if len(section.items) < 2 or section.items[1].is_list:
        refuse(section, f"a name is expected after `{section.head}`")
    name, parts = section.items[1], section.items[2:]
    durative = section.head == ":durative-action"
    condition = ":condition" if durative else ":precondition"
    known = (":parameters", condition, ":effect", *((":duration",) if durative else ()))
    found: dict[str, Node] = {}
    for key, value in zip(parts[::2], parts[1::2], strict=False):
        if key.word not in known:
            refuse(key, f"`{key}` is no part of `{name.written}`", did_you_mean(key.word, known))
        if key.word in found:
            refuse(key, f"`{name.written}` has a second `{key.written}`")
        found[key.word] = value
    if len(parts) % 2:
        refuse(parts[-1], f"nothing follows `{parts[-1]}` in `{name.written}`")
    variables = read_variables(found[":parameters"], domain) if ":parameters" in found else ()
    return Action(
        name, variables, found.get(condition), found.get(":effect"), found.get(":duration"), durative, section
    )


def _read_derived(section: Node, domain: Domain) -> Derived:
    if len(section.items) != 3 or not section.items[1].head:
        refuse(section, "a derived predicate is `(:derived (NAME VARIABLES) CONDITION)`")
    head = section.items[1]
    declared = domain.predicates.get(head.head)
    if declared is None:
        refuse(head, f"there is no predicate `{head.items[0].written}`", did_you_mean(head.head, domain.predicates))
    own = read_variables(Node(head.span, items=head.rest), domain)
    if len(own) != len(declared.parameters):
        refuse(head, f"`{head.head}` has {len(declared.parameters)} parameters, not {len(own)}")
    typed = (
        mine if OBJECT not in mine.types else Typed(mine.node, theirs.types)
        for mine, theirs in zip(own, declared.parameters, strict=True)
    )
    return Derived(Symbol(head.items[0], tuple(typed)), section.items[2])
