"""How each construct of the language is written, for messages about what does not fit in it."""

from __future__ import annotations

from collections.abc import Sequence
from types import MappingProxyType

from skillc_dsl.parsing.tokens import Token, Tree

WRITTEN = MappingProxyType(
    {
        "USE": "use NAME, NAME",
        "PREFIX": "prefix lab: <http://example.org/lab#>",
        "IMPORT": 'import "NAME.skill"',
        "CLASS": "class NAME < PARENT",
        "RELATION": "relation NAME(CLASS, CLASS)",
        "PROPERTY": "property NAME(CLASS): TYPE",
        "FUNCTION": 'function NAME(PARAMETER: TYPE) -> TYPE = python "MODULE:FUNCTION"',
        "SKILL": "skill NAME { .. }",
        "IMPL": "impl NAME of SKILL { .. }",
        "TASK": "task NAME { .. }",
        "TEST": "test NAME { .. }",
        "IN": "in NAME: TYPE",
        "OPT": "opt NAME: TYPE = VALUE range VALUE .. VALUE",
        "INFER": "infer NAME: CLASS",
        "OUT": "out NAME: TYPE",
        "REFINE": "refine NAME: TYPE",
        "LET": "let NAME = VALUE",
        "RUN": 'run python "MODULE:CLASS"',
        "SCENE": 'scene "FILE.ttl"',
        "EXPECT": 'expect CONDITION`, `expect failure "TEXT"` or `expect no plan',
        "PAR": "par all { .. }",
        **{word: f"{word.lower()} {{ .. }}" for word in ("SEQ", "SEL", "TRY", "INVERT", "ONCE")},
        "RETRY": "retry 3 { .. }",
        "REPEAT": "repeat 3 { .. }",
        "TIMEOUT": "timeout 3 s { .. }",
        "IF": "if C { .. } else { .. }",
        "WHILE": "while C max 10 { .. }",
        "FOR": "for NAME in LIST { .. }",
        "WITH": "with SKILL(..) { .. }",
        "CHECK": "check(C)",
        "WAIT": "wait 1 s` or `wait until C",
        "EXISTS": "exists NAME: CLASS (C)",
        "FORALL": "forall NAME: CLASS (C)",
    }
)
"""The form of what begins with each terminal."""


def show_construct(values: Sequence[Token | Tree]) -> str:
    """Return help with the form of the construct that the parser has begun, or an empty string."""
    for value in reversed(values):
        kind = value.type if isinstance(value, Token) else ""
        if kind in ("LBRACE", "RBRACE") or (isinstance(value, Tree) and value.data.endswith("_star")):
            return ""
        if kind in WRITTEN:
            return f"write `{WRITTEN[kind]}`"
    return ""
