"""A postcondition that not every successful end of the body establishes."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.analysis.findings import Finding, UnprovedPost, UnprovedPrecondition
from skillc_compiler.analysis.paths import ends_in_finally, path_labels
from skillc_compiler.analysis.proof import Proofs, findings_of
from skillc_compiler.analysis.remedy_lines import add_lines, format_change, quote_all, remedy_lines
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.typed import TypedNode
from skillc_compiler.program.walk import nodes_in
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, Label
from skillc_dsl.units import in_units_of
from skillc_model.traversal import free_variables
from skillc_rdf.vocabulary.types import Vocabulary

NAMES = ("post-not-established",)
NEEDS = Need.BODY
READS = Reads.PROOFS


def check(proofs: Proofs) -> Iterator[Diagnostic]:
    """Yield a problem for each postcondition that some successful end does not establish."""
    for several in _group_by_path(proofs):
        one = several[0]
        vocabulary = proofs[one.implementation.key].vocabulary
        verb = "makes it false" if one.false else "does not establish it"
        texts = quote_all(each.post.text for each in several)
        apart = one.remedy.apart if one.remedy is not None else ()
        same = " or ".join(f"`{left}` and `{right}` are the same" for left, right in apart)
        verb += f" if {same}" if same else ""
        lines = (
            remedy_lines(one.remedy, vocabulary, [each.post.text for each in several]) if one.remedy is not None else ()
        )
        yield Diagnostic(
            "post-not-established",
            one.implementation.name_span,
            f"`{one.implementation.name}` can succeed in a way that {verb}: {texts}",
            help=f"say that they differ: {quote_all(lines)}" if lines else _help(one, vocabulary),
            severity="warning" if one.beyond else "error",
            labels=(*(Label(each.post.span, "promised here") for each in several), *path_labels(one.path)),
            fix=add_lines(lines, one.implementation.skill) if lines else None,
        )


def _group_by_path(proofs: Proofs) -> Iterator[tuple[UnprovedPost, ...]]:
    """Group what the same path leaves open, as it has one cause.

    Of a body with a call that cannot start it is not known how it ends.
    """
    groups: dict[object, tuple[UnprovedPost, ...]] = {}
    sound = {key: proof for key, proof in proofs.items() if not any(map(_cannot_start, proof.findings))}
    for one in findings_of(sound, UnprovedPost):
        key = (id(one.implementation), id(one.path), one.false, one.beyond, one.remedy)
        groups[key] = (*groups.get(key, ()), one)
    return iter(groups.values())


def _cannot_start(finding: Finding) -> bool:
    return isinstance(finding, UnprovedPrecondition) and finding.false


def _help(one: UnprovedPost, vocabulary: Vocabulary) -> str:
    if one.instead is not None:
        change = in_units_of(format_change(one.instead, vocabulary), (one.post.text,))
        return f"its steps do `{change}`: declare that, or a range that contains it"
    names = free_variables(one.post.condition.meaning)
    taken = [each.name for each in one.implementation.skill.parameters if each.some and each.name in names]
    if taken and not one.false:
        return f"pass {quote_all(taken)} to the step that has this effect"
    body = one.implementation.body
    if one.path is not None and ends_in_finally(body, one.path):
        if not one.path.failed:
            return "`finally` does this after a success too: do it in `on failure`, or leave it out"
        return (
            "what fails in `finally` leaves the result as it is: establish this before it, or add `check(..)` after it"
        )
    if one.false:
        return "undo what makes it false, or remove the postcondition"
    if one.post.sensed or one.post.label is None:
        return "call a skill that establishes it, or test it: `check(..)`"
    label = one.post.label.text
    applied = (n.written for n in nodes_in(body)) if isinstance(body, TypedNode) else ()
    if any(isinstance(each, s.ApplyPosts) and label in {name.text for name in each.labels} for each in applied):
        return f"`apply {label}` is undone later, or is not reached: apply it last, on every path"
    return f"call a skill that establishes it, or write it yourself: `apply {label}`"
