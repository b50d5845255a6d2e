"""Reports a skill in place of a goal, with the condition that it makes true and the call that runs it."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Span
from skillc_model.conditions import Not
from skillc_model.format_condition import format_condition
from skillc_model.rewriting import ALWAYS
from skillc_model.skills import Skill
from skillc_rdf.vocabulary.types import Vocabulary

_FIRST = re.compile(r"(?:[\s(]|[#;].*\n)*(?:(?:do|goal|run|call)\s+)?(?P<name>[A-Za-z]\w*)(?![\w:.-])")
_INDIVIDUAL = re.compile(r"(?:\b(?P<label>\w+)\s*(?::|=)\s*)?(?P<name>\b[A-Za-z]\w*:[A-Za-z][\w-]*)")


def report_skill_as_goal(text: str, skills: Mapping[str, Skill], vocabulary: Vocabulary) -> Diagnostic | None:
    """Return the problem if the text of a goal begins with the name of a skill, in upper or lower case."""
    found = _FIRST.match(text)
    names = {name.casefold(): name for name in skills}
    name = names.get(found["name"].casefold()) if found else None
    if found is None or name is None:
        return None
    skill = skills[name]
    required = [each.name for each in skill.parameters if each.direction == "in"]
    values = _values(required, text[found.end() :])
    passed = ", ".join(f"{each}: {values.get(each, '..')}" for each in required)
    run = f"to run it, call it (`--call` on the command line): `{name}({passed})`"
    made = [each.condition for each in skill.post if not isinstance(each.condition, Not) and each.condition != ALWAYS]
    help_ = run
    if made:
        help_ = f"write what it makes true: `{_with_values(format_condition(made[0], vocabulary), values)}`; {run}"
    message = f"`{name}` is a skill, and a goal is a condition"
    return Diagnostic("not-a-condition", _span_of(text, found), message, help_)


def _values(required: Sequence[str], arguments: str) -> Mapping[str, str]:
    """Return the values of required parameters: individuals with their label, or the only one for the only one."""
    written = [(each["label"], each["name"]) for each in _INDIVIDUAL.finditer(arguments)]
    labelled = {label: name for label, name in written if label in required}
    if not labelled and len(written) == len(required) == 1:
        return {required[0]: written[0][1]}
    return labelled


def _with_values(condition: str, values: Mapping[str, str]) -> str:
    """Return the condition with the parameters that have a value replaced by it."""
    return re.sub(r"(?<![\w.:-])[A-Za-z]\w*(?![\w:-])", lambda word: values.get(word[0], word[0]), condition)


def _span_of(text: str, found: re.Match[str]) -> Span:
    start, end = found.span("name")
    line, begin = text.count("\n", 0, start) + 1, text.rfind("\n", 0, start) + 1
    return Span("goal", line, start - begin + 1, line, end - begin + 1)
