"""Conditions as other languages write them."""

from __future__ import annotations

from skillc_dsl.parsing.foreign.form import inner

_NAME = r"[^\W\d]\w*(?::[^\W\d][\w-]*)?"
_PATH = r"(?<![\w.:])(?<!\d )[^\W\d](?:[\w:.-]*\w)?"
"""A name with its prefix or properties, but not the unit of a quantity."""
_WHOLE = rf"(?<![-+*/] ){_PATH}"
"""A path that is not the last part of a sum or product, which would have to be repeated with it."""
_VALUE = rf"(?:\d[\d.]*(?:\s?(?!and\b|or\b)[A-Za-z][\w/]*)?|{_PATH})"
_LESS = r"(?:<=?|>=?|==)"
_NOT_WORDS = r"(?!(?:and|or|not|implies|pre|hold|post|goal|if|while|until|verify|never)\b)"
_SUBJECT = rf"\b{_NOT_WORDS}{_NAME}"

_THAN = r"(?:\b(?:is|are)\s+)?\b"
_TRIPLE = rf"\(\s*{_NAME}\s+{_NAME}\s+{_NAME}\s*\)"

FORMS = (
    inner(rf"(?P<a>{_NAME})\.(?P<b>{_NAME})\s+is\s+not\s+(?:None|null|nil|nothing|undefined)\b", r"\g<a> has \g<b>"),
    inner(rf"(?P<a>{_NAME}\.{_NAME})\s+is\s+not\s+(?P<b>{_NAME})", r"\g<a> != \g<b>"),
    inner(rf"(?P<a>{_SUBJECT})\s+is\s+not\s+(?:an?\s+)?(?P<b>{_NAME})", r"not \g<a> is \g<b>"),
    inner(rf"(?P<a>{_SUBJECT})\s+is\s+an?\s+(?P<b>{_NAME})", r"\g<a> is \g<b>"),
    inner(rf"(?P<a>{_SUBJECT})\s+not\s+(?P<b>{_NAME})\s+(?P<c>{_NAME})", r"not \g<a> \g<b> \g<c>"),
    inner(rf"(?P<a>{_SUBJECT})\s+(?P<b>{_NAME})\s+no\s+(?P<c>{_NAME})", r"not \g<a> \g<b> \g<c>"),
    inner(
        rf"(?P<a>{_VALUE})\s*(?P<b>{_LESS})\s*(?P<c>{_VALUE})\s*(?P<d>{_LESS})\s*(?P<e>{_VALUE})",
        r"\g<a> \g<b> \g<c> and \g<c> \g<d> \g<e>",
    ),
    inner(
        rf"(?P<a>(?P<d>{_WHOLE})\s*(?:{_LESS}|!=)\s*{_VALUE})\s+(?P<b>and|or)\s+(?=[<>=!])",
        r"\g<a> \g<b> \g<d> ",
    ),
    inner(rf"(?P<a>{_WHOLE})\s+(?P<b>and|or)\s+(?=[<>=!])", r"\g<a> \g<b> \g<a> "),
    inner(rf"(?P<a>{_SUBJECT})\s+has\s+(?P<b>{_NAME})\s*(?={_LESS})", r"\g<a>.\g<b> "),
    inner(rf"(?P<a>{_SUBJECT}\s+{_NAME}\s+{_NAME})\s*={{1,2}}\s*true\b", r"\g<a>"),
    inner(rf"(?P<a>{_SUBJECT}\s+{_NAME}\s+{_NAME})\s*={{1,2}}\s*false\b", r"not \g<a>"),
    inner(
        rf"(?P<a>{_WHOLE})\s+(?:between\s+(?P<b>{_VALUE})\s+and|in\s+(?P<d>{_VALUE})\s*\.\.)\s*(?P<c>{_VALUE})",
        r"\g<a> >= \g<b>\g<d> and \g<a> <= \g<c>",
    ),
    inner(
        rf"(?P<a>{_WHOLE})\s+in\s+\[(?P<b>{_VALUE}),\s*(?P<c>{_VALUE})\]",
        r"(\g<a> == \g<b> or \g<a> == \g<c>)",
    ),
    inner(rf"\b(?P<a>{_NAME})\(\w+:\s.*", None, r"a skill is not a condition: `do \g<a>(..)` runs it", "TRUE"),
    inner(rf"\bhas\s*\(\s*(?P<a>{_NAME})\s*,\s*(?P<b>{_NAME})\s*\)", r"\g<a> has \g<b>"),
    inner(rf"\bexists\s*\(\s*(?P<a>{_NAME})\.(?P<b>{_NAME})\s*\)", r"\g<a> has \g<b>"),
    inner(rf"(?P<a>{_NAME})\.(?P<b>{_NAME})\s+exists\b", r"\g<a> has \g<b>"),
    inner(rf"(?P<a>{_NAME})(?:\.|->)(?P<b>{_NAME})\(\s*(?P<c>{_NAME})\s*\)", r"\g<a> \g<b> \g<c>"),
    inner(rf"(?P<a>{_NAME})->(?P<b>{_NAME})", r"\g<a>.\g<b>"),
    inner(rf"{_THAN}(?:greater|larger|more|higher)\s+than\s+or\s+equal\s+to\b|{_THAN}at\s+least\b", ">="),
    inner(rf"{_THAN}(?:less|smaller|lower|fewer)\s+than\s+or\s+equal\s+to\b|{_THAN}at\s+most\b", "<="),
    inner(rf"{_THAN}(?:greater|larger|more|higher|bigger)\s+than\b", ">"),
    inner(rf"{_THAN}(?:less|smaller|lower|fewer)\s+than\b", "<"),
    inner(rf"{_THAN}(?:equal\s+to|same\s+as|equals?)\b", "=="),
    inner(r"=/=|~=|\\=", "!="),
    inner(r"<=>|\biff\b", None, "write `(A implies B) and (B implies A)`"),
    inner(r"\bxor\b", None, "write `(A and not B) or (B and not A)`"),
    inner(r"=>", ">=", where="MORE_EQUAL"),
    inner(r"=>", "implies", where="IMPLIES"),
    inner(rf"\(\s*(?P<a>and|or)(?=\s*{_TRIPLE})", None, r"write `a RELATION b \g<a> c RELATION d`"),
    inner(r"\(\s*(?:increase|decrease|assign)\b.*", None, "write what is added, such as `a.count += 1`"),
    inner(r"\bfor\s+all\b", "forall"),
    inner(r"\bthere\s+(?:exists|is)\b", "exists"),
    inner(
        rf"\b(?P<a>exists|forall)\s+(?P<b>\w+)\s*,\s*(?P<c>\w+)\s*:\s*(?P<d>{_NAME})",
        r"\g<a> \g<b>: \g<d>, \g<c>: \g<d>",
    ),
    inner(
        rf"\b(?P<a>exists|forall)\s*\(?\s*(?P<b>\w+)\s*(?::|\bin\b)\s*(?P<c>{_NAME})\b\s*\)?\s*(?:[.:,]\s*+)?+"
        r"(?:\((?P<d>.*)\)|(?P<e>(?!\w+\s*:)[^(].*\S))\s*$",
        r"\g<a> \g<b>: \g<c> (\g<d>\g<e>)",
    ),
    inner(r"\bif\s+(?P<a>.*?)\s+then\s+(?P<b>.*\S)", r"\g<a> implies \g<b>", where="LABEL"),
    inner(rf"\b(?:delete|remove)\s+(?P<a>{_NAME}\s+{_NAME}\s+{_NAME})", r"not \g<a>"),
    inner(r"\*", "_", where="UNDERSCORE"),
    inner(r"\{\s*(?P<a>[^}]*?)\s*\}", r"\g<a>", where="NOT"),
    inner(r"\s*[,;]\s*(?=\S)", " and ", where="AND"),
    inner(r"\s*->\s*", " implies ", where="IMPLIES"),
)
