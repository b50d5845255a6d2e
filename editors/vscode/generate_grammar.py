"""Makes the TextMate grammar from the language's table of tokens; `python tests/accept.py` writes it.

The grammar colours what can be told from a line alone; names get their colours from the language server.
"""

from __future__ import annotations

import json
import re
from typing import TypeAlias

from skillc_dsl.token_table import KEYWORDS, NAME, NUMBER, OPERATORS, PATTERNS, TYPES, UNIT, Group

Rule: TypeAlias = dict[str, str | dict[str, dict[str, str]]]

SCOPES: dict[Group, str] = {
    "declaration": "keyword.declaration",
    "member": "storage.modifier",
    "flag": "storage.modifier.flag",
    "trait": "storage.modifier.trait",
    "step": "keyword.control",
    "property": "keyword.other.property",
    "logic": "keyword.operator.word",
    "constant": "constant.language",
}
DECLARED = {
    "skill": "entity.name.function",
    "task": "entity.name.function",
    "test": "entity.name.function",
    "function": "entity.name.function",
    "class": "entity.name.type.class",
    "relation": "entity.name.function.relation",
    "property": "variable.other.property",
}


def rule(match: str, *scopes: str, name: str = "") -> Rule:
    """Return a rule: the scope of the whole match, or those of its groups."""
    captures = {str(number): {"name": f"{scope}.skill"} for number, scope in enumerate(scopes, 1) if scope}
    return {
        **({"name": f"{name}.skill"} if name else {}),
        "match": match,
        **({"captures": captures} if captures else {}),
    }


def rules() -> list[Rule]:
    """Return the rules; where several match at a place, the first one wins."""
    plain = {kind: _plain(pattern) for kind, pattern in PATTERNS.items()}
    keyword = SCOPES["declaration"]
    return [
        rule(plain["documentation"], name="comment.line.documentation"),
        rule(
            r"(#)\s*(allow)\s+([\w-]+)(:.*)?$",
            "",
            "keyword.other.allow",
            "constant.other.diagnostic",
            name="comment.line",
        ),
        rule(plain["comment"], name="comment.line.number-sign"),
        rule(plain["text"], name="string.quoted.double"),
        rule(r'"[^"\n]*$', name="invalid.illegal.unclosed"),
        rule(
            rf"\b(prefix)\s+({NAME})(:)\s+({plain['address']})",
            keyword,
            "entity.name.namespace",
            "",
            "string.other.address",
        ),
        rule(
            rf"\b(impl)\s+({NAME})\s+(of)\s+({NAME})",
            keyword,
            "entity.name.function.implementation",
            keyword,
            "entity.name.function",
        ),
        *(rule(rf"\b({word})\s+({NAME})", keyword, scope) for word, scope in DECLARED.items()),
        rule(
            rf"\b(in|opt|infer|out|refine)(?:\s+(any))?\s+({NAME})(:)",
            SCOPES["member"],
            SCOPES["member"],
            "variable.parameter",
        ),
        rule(rf"\b(let)\s+({NAME})", SCOPES["member"], "variable.other.constant"),
        rule(rf"\b({NAME})(:)(?=\s|$)", "entity.name.label"),
        rule(rf"\b({NAME})(:)([^\W\d][\w-]*)", "entity.name.namespace", "", "variable.other.qualified"),
        rule(rf"(?<!\d)({_plain(NUMBER)})[ \t]*({UNIT})(?!\w)", "constant.numeric", "keyword.other.unit"),
        rule(_plain(NUMBER), name="constant.numeric"),
        rule(rf"(?<=\.)(?<!\.\.){NAME}", name="variable.other.property"),
        rule(rf"\b(?:{'|'.join(TYPES)})\b", name="support.type"),
        *(rule(rf"\b(?:{'|'.join(words)})\b", name=SCOPES[group]) for group, words in KEYWORDS.items()),
        rule(rf"\b{NAME}(?=\s*\(|\[\w+\]\()", name="entity.name.function.call"),
        rule("|".join(re.escape(operator) for operator in OPERATORS), name="keyword.operator"),
        rule(NAME, name="variable.other"),
    ]


def grammar() -> str:
    """Return the grammar as JSON."""
    content = {"name": "Skill", "scopeName": "source.skill", "fileTypes": ["skill"], "patterns": rules()}
    return json.dumps(content, indent=2, ensure_ascii=False) + "\n"


def _plain(pattern: str) -> str:
    """Return a pattern whose groups capture nothing."""
    return re.sub(r"(?<!\\)\((?!\?)", "(?:", pattern)
