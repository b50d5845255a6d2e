"""Where a server is, and which token it gets: as given, from the environment, or from the state folder here."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from ipaddress import ip_address
from pathlib import Path
from urllib.parse import urlsplit

from skillc.contract.api.endpoint import PREFIX
from skillc.errors import RequestError

DEFAULT_URL = "http://127.0.0.1:8421"
URL_VARIABLE, TOKEN_VARIABLE = "SKILLC_SERVER", "SKILLC_TOKEN"
STATE = Path(".skillc")
ADMIN_TOKEN = "admin.token"
"""The file with the token of the command line."""
ADDRESS = "address"
"""The file with the address of the server that runs."""


@dataclass(frozen=True, slots=True)
class ServerAddress:
    """A server, by the address of its API without a slash at the end; `is_local` if it is on this machine."""

    url: str
    is_local: bool
    token: str = field(repr=False)


def find_address(url: str | None, token: str | None, state: Path | None) -> ServerAddress:
    """Return the address that is given, else SKILLC_SERVER, the one in the folder `state`, or the default one.

    Without a token that is given, and SKILLC_TOKEN, a server on this machine gets the one in the folder `state`.
    RequestError if there is none, or an address would get it in the clear.
    """
    folder = state or STATE
    given = url or os.environ.get(URL_VARIABLE) or read_address(folder) or DEFAULT_URL
    server = given.rstrip("/").removesuffix(PREFIX)
    parts = urlsplit(server)
    if parts.scheme not in ("http", "https") or not parts.hostname or parts.query or parts.fragment:
        raise RequestError(f"`{server}` is no address of a server; write one such as {DEFAULT_URL}")
    is_local = is_loopback(parts.hostname)
    if parts.scheme == "http" and not is_local:
        raise RequestError(f"{server} would get a token in the clear; a server on another machine needs https")
    return ServerAddress(server + PREFIX, is_local, token or _find_token(server, is_local, folder))


def read_token_file(file: Path) -> str:
    """Return the token in a file; RequestError if there is none."""
    token = read_token(file)
    if not token:
        raise RequestError(f"{file} has no token that this user can read")
    return token


def read_token(file: Path) -> str | None:
    """Return the token in a file; None if there is none, or it is not for the user of this process."""
    try:
        return file.read_text(encoding="ascii").strip()
    except (OSError, UnicodeDecodeError):
        return None


def read_address(folder: Path) -> str | None:
    """Return the address of the server that uses a state folder; it may have died since. None if there is none."""
    try:
        return (folder / ADDRESS).read_text(encoding="ascii").strip()
    except (OSError, UnicodeDecodeError):
        return None


def _find_token(server: str, is_local: bool, state: Path) -> str:
    if token := os.environ.get(TOKEN_VARIABLE):
        return token
    if is_local and (found := read_token(state / ADMIN_TOKEN)):
        return found
    where = f"{state / ADMIN_TOKEN} does not exist; " if is_local else ""
    raise RequestError(
        f"there is no token for {server}: {where}start a server here with `skillc serve`, or set {TOKEN_VARIABLE}"
    )


def is_loopback(host: str) -> bool:
    """Whether a host is this machine."""
    try:
        return ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"
