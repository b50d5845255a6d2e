"""Addresses of SPARQL servers: credentials are sent to the server but never shown."""

from __future__ import annotations

import base64
import re
from dataclasses import dataclass, field, replace
from urllib.parse import SplitResult, parse_qsl, unquote, urlsplit

from skillc_runtime.world.state.transactions import StoreError

HIDDEN = "***"


def without_credentials(place: str) -> str:
    """Return the place of a store without parts that may be secret: everything before an `@`, and the query."""
    scheme, mark, rest = place.partition("://")
    return scheme + mark + rest.rpartition("@")[2].partition("?")[0].partition("#")[0] if mark else place


@dataclass(frozen=True, slots=True)
class Address:
    """An `http://` or `https://` address; as text without credentials, for messages.

    Credentials are `user:password@` before the host, and the query.
    """

    name: str
    _parts: SplitResult = field(repr=False)

    @staticmethod
    def parse(text: str) -> Address:
        """Return the address in a text; StoreError when it is not one."""
        name = without_credentials(text)
        try:
            parts = urlsplit(text)
            usable = parts.scheme in ("http", "https") and bool(parts.hostname) and parts.port != 0
        except ValueError:
            usable = False
        if not usable or not text.isascii() or re.search(r"[\x00-\x20\x7f]", text):
            raise StoreError(
                f"{name} is not an address of a SPARQL server; it begins with http:// or https:// and a host"
            )
        if "@" in parts.path + parts.query + parts.fragment or "#" in text:
            raise StoreError(
                f"the address that ends with {name} is ambiguous: in a user name or a password "
                "`/` is written %2F, `?` %3F, `#` %23 and `@` %40"
            )
        return Address(name.rstrip("/"), parts._replace(path=parts.path.rstrip("/")))

    def __str__(self) -> str:
        return self.name

    def append_path(self, path: str) -> Address:
        """Return the address with a path appended."""
        return replace(self, name=self.name + path, _parts=self._parts._replace(path=self._parts.path + path))

    @property
    def is_encrypted(self) -> bool:
        """Whether the connection uses TLS."""
        return self._parts.scheme == "https"

    @property
    def host(self) -> str:
        """The name or number of the server."""
        return self._parts.hostname or ""

    @property
    def port(self) -> int | None:
        """The port; None for the default."""
        return self._parts.port

    @property
    def target(self) -> str:
        """The request target: path and query."""
        return (self._parts.path or "/") + (f"?{self._parts.query}" if self._parts.query else "")

    def authorization(self) -> dict[str, str]:
        """Return the header with the credentials; empty without a user."""
        if self._parts.username is None:
            return {}
        pair = f"{unquote(self._parts.username)}:{unquote(self._parts.password or '')}"
        return {"Authorization": f"Basic {base64.b64encode(pair.encode()).decode()}"}

    def without_secrets(self, text: str) -> str:
        """Return a text from the server, which may repeat the request, without the credentials."""
        secrets = [value for _, value in parse_qsl(self._parts.query)]
        secrets += [self._parts.query, self._parts.password or "", self._parts.netloc.rpartition("@")[0]]
        secrets += [header.removeprefix("Basic ") for header in self.authorization().values()]
        for secret in sorted({each for one in secrets for each in (one, unquote(one)) if each}, key=len, reverse=True):
            text = text.replace(secret, HIDDEN)
        return text
