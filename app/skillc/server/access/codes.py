"""One-time codes: the command line hands a browser one, so that no token is ever in an address."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from hashlib import sha256
from secrets import token_urlsafe

CODE_BYTES = 24
LIFETIME_S = 60.0
"""How long a code may be used, in s."""
MAX_CODES = 1000
"""How many codes are known; one more ends the oldest one."""


@dataclass(slots=True)
class LoginCodes:
    """The codes that were not used yet, as hashes, with the hashes of the tokens that they stand for.

    They end with the server; `clock` is monotonic, in s.
    """

    clock: Callable[[], float] = time.monotonic
    _codes: dict[bytes, tuple[bytes, float]] = field(default_factory=dict)

    def make(self, token: bytes) -> str:
        """Return a code that stands for the token with a hash, once, for LIFETIME_S."""
        code = token_urlsafe(CODE_BYTES)
        self._codes[_hash(code)] = token, self.clock() + LIFETIME_S
        if len(self._codes) > MAX_CODES:
            del self._codes[next(iter(self._codes))]
        return code

    def take(self, code: str) -> bytes | None:
        """Return the hash of the token that a code stands for, which is used up; None if it is not, or no longer, one.

        The hash of the code is looked up, so the time that it takes tells nothing about other codes.
        """
        token, end = self._codes.pop(_hash(code), (None, 0.0))
        return token if self.clock() < end else None


def _hash(code: str) -> bytes:
    return sha256(code.encode()).digest()
