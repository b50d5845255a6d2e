"""The datatypes whose values are texts in the skill language, such as dates, and the forms that these texts have."""

from __future__ import annotations

import re
from calendar import monthrange
from typing import NamedTuple

from skillc_rdf.vocabulary.iris import XSD

_ZONE = r"(?:Z|[+-](?:(?:0[0-9]|1[0-3]):[0-5][0-9]|14:00))"
_YEAR = r"(?P<year>-?(?:[1-9][0-9]{3,8}|0[0-9]{3}))"
_MONTH, _DAY = r"(?P<month>0[1-9]|1[0-2])", r"(?P<day>0[1-9]|[12][0-9]|3[01])"
_TIME = r"(?:(?:[01][0-9]|2[0-3]):[0-5][0-9]:[0-5][0-9](?:\.[0-9]+)?|24:00:00(?:\.0+)?)"
_DAYS = r"(?:[0-9]+D)?(?:T(?=[0-9])(?:[0-9]+H)?(?:[0-9]+M)?(?:[0-9]+(?:\.[0-9]+)?S)?)?"


class TextForm(NamedTuple):
    """The form of the texts of a datatype, and one of them."""

    pattern: str
    example: str

    def fits(self, text: str) -> bool:
        """Whether a text has the form; the day of a date exists in its month."""
        found = re.fullmatch(self.pattern, text)
        parts = found.groupdict() if found else {}
        if "month" not in parts or "day" not in parts:
            return found is not None
        leap_like = 2000 + int(parts.get("year", 0)) % 400  # the calendar repeats after 400 years
        return int(parts["day"]) <= monthrange(leap_like, int(parts["month"]))[1]


FORMS = {
    f"{XSD}dateTime": TextForm(rf"{_YEAR}-{_MONTH}-{_DAY}T{_TIME}{_ZONE}?", "2026-11-29T08:30:00Z"),
    f"{XSD}dateTimeStamp": TextForm(rf"{_YEAR}-{_MONTH}-{_DAY}T{_TIME}{_ZONE}", "2026-11-29T08:30:00Z"),
    f"{XSD}date": TextForm(rf"{_YEAR}-{_MONTH}-{_DAY}{_ZONE}?", "2026-11-29"),
    f"{XSD}time": TextForm(rf"{_TIME}{_ZONE}?", "08:30:00"),
    f"{XSD}gYear": TextForm(rf"{_YEAR}{_ZONE}?", "2026"),
    f"{XSD}gYearMonth": TextForm(rf"{_YEAR}-{_MONTH}{_ZONE}?", "2026-11"),
    f"{XSD}gMonth": TextForm(rf"--{_MONTH}{_ZONE}?", "--11"),
    f"{XSD}gMonthDay": TextForm(rf"--{_MONTH}-{_DAY}{_ZONE}?", "--11-29"),
    f"{XSD}gDay": TextForm(rf"---{_DAY}{_ZONE}?", "---29"),
    f"{XSD}duration": TextForm(rf"-?P(?=[0-9T])(?:[0-9]+Y)?(?:[0-9]+M)?{_DAYS}", "P1DT2H"),
    f"{XSD}dayTimeDuration": TextForm(rf"-?P(?=[0-9T]){_DAYS}", "P1DT2H"),
    f"{XSD}yearMonthDuration": TextForm(r"-?P(?=[0-9])(?:[0-9]+Y)?(?:[0-9]+M)?", "P1Y2M"),
    f"{XSD}hexBinary": TextForm(r"(?:[0-9A-Fa-f]{2})*", "0FB7"),
}
"""The datatypes whose texts have a form that is checked."""
FREE = frozenset(
    f"{XSD}{name}"
    for name in (
        *("normalizedString", "token", "language", "Name", "NCName", "NMTOKEN", "NMTOKENS", "ID", "IDREF", "IDREFS"),
        *("ENTITY", "ENTITIES", "QName", "NOTATION", "base64Binary"),
    )
)
"""Other datatypes of texts."""
