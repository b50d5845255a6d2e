"""A change or set-up that is not undone when a child fails."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.analysis.findings import LeakedChange
from skillc_compiler.analysis.paths import path_labels
from skillc_compiler.analysis.proof import Proofs, findings_of
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_dsl.diagnostics import Diagnostic, Label

NAMES = ("not-released",)
NEEDS = Need.BODY
READS = Reads.PROOFS


def check(proofs: Proofs) -> Iterator[Diagnostic]:
    """Yield a problem for each call whose change or set-up is not undone."""
    for one in findings_of(proofs, LeakedChange):
        name, cause = one.call.written.skill, path_labels(one.path)
        if one.post is None:
            message = f"what `{name.text}` sets up is not undone when this skill ends"
            help_ = f"write `with {name.text}(..) {{ .. }}` around what needs it"
        else:
            message = f"`{name.text}` causes `{one.post.text}`, which remains when a later child fails"
            help_ = f"declare `{name.text}` `scoped` and write `with {name.text}(..) {{ .. }}`"
            cause = (Label(one.post.span, "the effect"), *cause)
        yield Diagnostic("not-released", name.span, message, help_, "warning", labels=cause)
