"""Which versions a server has."""

from __future__ import annotations

import msgspec


class VersionInfo(msgspec.Struct, frozen=True):
    """The version of skillc, and that of the API."""

    skillc: str
    api: str
