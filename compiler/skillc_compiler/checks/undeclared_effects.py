"""A child that changes something that its skill does not declare."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence

from skillc_compiler.analysis.findings import UndeclaredEffect
from skillc_compiler.analysis.paths import path_labels
from skillc_compiler.analysis.proof import Proofs, findings_of
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.typed import Skill
from skillc_dsl.diagnostics import Diagnostic, Fix, Label

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
        fix = _declare([one, *others], skill)
        yield Diagnostic(
            "undeclared-effect",
            one.call.written.skill.span,
            f"`{one.call.written.skill.text}` causes `{one.post.text}`, which `{skill.name}` does not declare",
            help=f"add a `post` that declares it to `{skill.name}` or to this implementation, or undo it",
            labels=(
                Label(one.post.span, "the effect"),
                Label(fix.span if fix else skill.name_span, "whose posts do not declare it"),
                *(Label(other.call.written.skill.span, f"causes `{other.post.text}`") for other in others),
                *path_labels(one.path),
            ),
            fix=fix,
        )


def _declare(effects: Sequence[UndeclaredEffect], skill: Skill) -> Fix | None:
    """Return the edit that adds the missing postconditions at the end of a skill; None if they cannot be written."""
    posts = [each for each in skill.requirements if each.kind == "post"]
    lines = posts or skill.requirements or skill.parameters
    if not lines or not all(each.missing for each in effects):
        return None
    last = lines[-1].span
    added = [f"post {each}" for each in dict.fromkeys(each.missing for each in effects)]
    text = "".join(f"\n{' ' * (last.column - 1)}{line}" for line in added)
    return Fix(last.after, text, f"add {' and '.join(f'`{line}`' for line in added)}", safe=False)
