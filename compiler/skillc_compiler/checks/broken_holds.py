"""A child that breaks a hold of its skill."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.analysis.findings import BrokenHold
from skillc_compiler.analysis.paths import path_labels
from skillc_compiler.analysis.proof import Proofs, findings_of
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_dsl.diagnostics import Diagnostic, Label

NAMES = ("hold-broken",)
NEEDS = Need.BODY
READS = Reads.PROOFS


def check(proofs: Proofs) -> Iterator[Diagnostic]:
    """Yield a problem for each hold that a child breaks before other children run."""
    found = tuple(findings_of(proofs, BrokenHold))
    certain = {(id(one.hold), one.span) for one in found if one.certain}
    for one in found:
        if not one.certain and (id(one.hold), one.span) in certain:
            continue
        verb = "breaks" if one.certain else "may break"
        yield Diagnostic(
            "hold-broken",
            one.span,
            f"this {verb} the hold `{one.hold.text}` while the skill still runs",
            help="do it last, or remove the `hold`"
            if one.certain
            else "add a `pre` that rules this out, or do it last",
            severity="error" if one.certain else "warning",
            labels=(Label(one.hold.span, "must hold all the time", is_cause=True), *path_labels(one.path)),
        )
