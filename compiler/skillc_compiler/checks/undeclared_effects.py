"""A child that changes something that its skill does not declare."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator

from skillc_compiler.analysis.findings import UndeclaredEffect
from skillc_compiler.analysis.paths import path_labels
from skillc_compiler.analysis.proof import Proofs, findings_of
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_dsl.diagnostics import Diagnostic, Label

NAMES = ("undeclared-effect",)
NEEDS = Need.BODY
READS = Reads.PROOFS


def check(proofs: Proofs) -> Iterator[Diagnostic]:
    """Yield a problem for each body with effects of calls that last beyond the skill and that no `post` declares."""
    groups: dict[str, list[UndeclaredEffect]] = defaultdict(list)
    for one in findings_of(proofs, UndeclaredEffect):
        groups[one.implementation.key].append(one)
    for one, *others in groups.values():
        skill = one.implementation.skill
        yield Diagnostic(
            "undeclared-effect",
            one.call.written.skill.span,
            f"`{one.call.written.skill.text}` causes `{one.post.text}`, which `{skill.name}` does not declare",
            help=f"add a `post` that declares it to `{skill.name}` or to this implementation, or undo it",
            labels=(
                Label(one.post.span, "the effect"),
                Label(skill.name_span, "whose posts do not declare it"),
                *(Label(other.call.written.skill.span, f"causes `{other.post.text}`") for other in others),
                *path_labels(one.path),
            ),
        )
