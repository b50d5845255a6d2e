"""A child that changes something that its skill does not declare."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence

from skillc_compiler.analysis.findings import Remedy, UndeclaredEffect
from skillc_compiler.analysis.paths import ends_in_finally, path_labels
from skillc_compiler.analysis.proof import Proofs, findings_of
from skillc_compiler.analysis.remedies import is_on_found
from skillc_compiler.analysis.remedy_lines import add_lines, quote_all, remedy_lines
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.typed import Implementation, Skill, TypedNode
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_model.traversal import walk
from skillc_rdf.vocabulary.types import Vocabulary

NAMES = ("undeclared-effect",)
NEEDS = Need.BODY
READS = Reads.PROOFS


def check(proofs: Proofs) -> Iterator[Diagnostic]:
    """Yield a problem for each body with effects of calls that last beyond the skill and that no `post` declares."""
    groups: dict[str, list[UndeclaredEffect]] = defaultdict(list)
    for one in findings_of(proofs, UndeclaredEffect):
        groups[one.implementation.key].append(one)
    for key, effects in groups.items():
        yield _report(effects, proofs[key].vocabulary)


def _report(effects: Sequence[UndeclaredEffect], vocabulary: Vocabulary) -> Diagnostic:
    (one, *others), skill = effects, effects[0].implementation.skill
    declarable = [each for each in effects if each.remedy is not None]
    lines = _lines(declarable, one.implementation, vocabulary)
    is_open = any(each.remedy is not None and each.remedy.possible is not None for each in effects)
    lines += ("noplan",) if is_open and "noplan" not in skill.flags else ()
    unsaid = [each for each in effects if each.remedy is None]
    found = [each.post.text for each in unsaid if each.effect is not None and is_on_found(each.effect)]
    left = [each.post.text for each in unsaid if each.effect is None or not is_on_found(each.effect)]
    calls = dict.fromkeys(each.call.written.skill.text for each in effects)
    verb = "causes" if len(calls) == 1 else "cause"
    passing = [each for each in effects if each.remedy is not None and each.remedy.passed]
    passed = quote_all(name for each in passing if each.remedy is not None for name in each.remedy.passed)
    then = f", and pass {passed} to {quote_all(each.call.written.skill.text for each in passing)}" if passed else ""
    where = f"`{skill.name}`" + (
        "" if is_open or any(" some " in each for each in lines) else " or to this implementation"
    )
    return Diagnostic(
        "undeclared-effect",
        one.call.written.skill.span,
        f"{quote_all(calls)} {verb} {quote_all(each.post.text for each in effects)}, "
        f"which `{skill.name}` does not declare",
        help=". ".join((*_help(lines, left, found, where, then), *_about_finally(effects))),
        labels=(
            Label(one.post.span, "the effect"),
            Label(skill.name_span, "whose posts do not declare it"),
            *_place_of_post(skill),
            *dict.fromkeys(Label(other.call.written.skill.span, f"causes `{other.post.text}`") for other in others),
            *path_labels(one.path),
        ),
        fix=add_lines(lines, skill) if lines and not passed and not unsaid else None,
    )


def _place_of_post(skill: Skill) -> Iterator[Label]:
    """Yield the last line below which a post would stand."""
    posts = [each for each in skill.requirements if each.kind == "post"] or skill.requirements
    if posts:
        yield Label(posts[-1].span, "it could be declared below this line")


def _help(lines: Sequence[str], left: Sequence[str], found: Sequence[str], where: str, then: str) -> Iterator[str]:
    """Yield what cures it: lines to add, and what to do about the effects that no post can say."""
    if lines:
        yield f"add {quote_all(lines)} to {where}{then}, or undo it"
    if left:
        which = f"{quote_all(dict.fromkeys(left))}: " if lines else ""
        yield f"{which}undo it, or let every success have it, or none: no `post` says what only some have"
    if found:
        which = f"{quote_all(found)}: " if lines or left else ""
        yield f"{which}pass what the call finds itself, in a loop one of a list: `for x in [one, other] {{ .. }}`"


def _about_finally(effects: Sequence[UndeclaredEffect]) -> Iterator[str]:
    """Yield why it counts that `finally` undoes an effect, if it does not on the path that is shown."""
    (one, *_) = effects
    if one.path is not None and one.path.failed and ends_in_finally(one.implementation.body, one.path):
        yield "What fails in `finally` leaves the result as it is: undo it before that, or `check(..)` after it"


def _quantities(own: Implementation) -> Iterator[str]:
    """Yield the quantities of a body and of its skill as they are written."""
    if isinstance(own.body, TypedNode):
        yield from (f"{each.value} {each.unit}" for each in walk(own.body.written) if isinstance(each, s.Quantity))
    yield from (each.text for each in own.skill.requirements)


def _lines(effects: Sequence[UndeclaredEffect], own: Implementation, vocabulary: Vocabulary) -> tuple[str, ...]:
    """Return the lines that declare all effects, parameters first."""
    remedies = [each.remedy for each in effects if each.remedy is not None]
    taken = [each.some for each in remedies if each.some is not None]
    open_ = [each.possible for each in remedies if each.possible is not None]
    asked = (each for one in effects if one.call.skill is not None for each in one.call.skill.requirements)
    written = [*(each.post.text for each in effects), *(each.text for each in asked), *_quantities(own)]
    whole = Remedy(
        parameters=tuple(part for each in remedies for part in each.parameters),
        before=tuple(part for each in remedies for part in each.before),
        after=tuple(part for each in remedies for part in each.after),
        outputs=tuple(part for each in remedies for part in each.outputs),
    )
    said = (*(Remedy(some=each) for each in taken), *(Remedy(possible=each) for each in open_))
    others = (line for each in said for line in remedy_lines(each, vocabulary, written))
    return tuple(dict.fromkeys((*remedy_lines(whole, vocabulary, written), *others)))
