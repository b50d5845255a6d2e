"""A called skill whose precondition does not hold at its start, or is not known to hold."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.analysis.findings import UnprovedPrecondition
from skillc_compiler.analysis.paths import path_labels
from skillc_compiler.analysis.proof import Proof, Proofs
from skillc_compiler.analysis.remedy_lines import add_lines, quote_all, remedy_lines
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.typed import Implementation
from skillc_dsl.diagnostics import Diagnostic, Fix, Label
from skillc_model.traversal import free_variables

NAMES = ("child-precondition",)
NEEDS = Need.BODY
READS = Reads.PROOFS


def check(proofs: Proofs) -> Iterator[Diagnostic]:
    """Yield a problem for each such precondition of each call."""
    for proof in proofs.values():
        for one in (each for each in proof.findings if isinstance(each, UnprovedPrecondition)):
            yield _report(one, proof)


def _report(one: UnprovedPrecondition, proof: Proof) -> Diagnostic:
    name, text = one.call.written.skill.text, one.requirement.text
    what = "does not hold" if one.false else "is not guaranteed"
    help_, fix = _help(one, proof)
    return Diagnostic(
        "child-precondition",
        one.call.written.skill.span,
        f"`{name}` needs `{text}`, which {what} here",
        help=help_,
        severity="error" if one.false else "warning",
        labels=(Label(one.requirement.span, "needed here"), *path_labels(one.path)),
        fix=fix,
    )


def _help(one: UnprovedPrecondition, proof: Proof) -> tuple[str, Fix | None]:
    """Return what to do, and the edit that does it; a precondition is recommended only if it is enough."""
    asked = free_variables(one.requirement.condition.meaning)
    handed = [own for each in one.call.handed if each.name.text in asked for own in free_variables(each.value.meaning)]
    if one.false and handed:
        what = quote_all(handed)
        return f"it takes {what}, as a step before did: say what becomes of another one too, and pass that here", None
    if one.false:
        return "call it where its precondition holds, or establish it before", None
    if isinstance(proof.of, Implementation) and one.remedy is not None:
        lines = remedy_lines(one.remedy, proof.vocabulary, (one.requirement.text,))
        help_ = f"add {quote_all(lines)} to `{proof.of.skill.name}`, or establish it before"
        return help_, add_lines(lines, proof.of.skill)
    if one.incurable:
        return "no `pre` is enough, as steps before may change it: establish it here, or test it: `check(..)`", None
    return "establish it before, or test it: `check(..)`", None
