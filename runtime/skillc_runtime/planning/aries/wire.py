"""Messages in the wire format of Protocol Buffers, as far as problems need it: https://protobuf.dev/programming-guides/encoding/"""

from __future__ import annotations

_VARINT, _LENGTH_DELIMITED = 0, 2


def encode_message(*fields: bytes) -> bytes:
    """Return a message made of fields."""
    return b"".join(fields)


def encode_number(field: int, value: int) -> bytes:
    """Return a field with a number that is not negative, a truth value or a member of an enumeration."""
    return _varint(field << 3 | _VARINT) + _varint(value)


def encode_text(field: int, value: str) -> bytes:
    """Return a field with a text."""
    return encode_nested(field, value.encode())


def encode_nested(field: int, value: bytes) -> bytes:
    """Return a field with a message."""
    return _varint(field << 3 | _LENGTH_DELIMITED) + _varint(len(value)) + value


def _varint(value: int) -> bytes:
    """Return seven bits a byte, the lowest first; all bytes but the last have the highest bit set."""
    groups = [value & 0x7F]
    while value := value >> 7:
        groups.append(value & 0x7F)
    return bytes(group | 0x80 for group in groups[:-1]) + bytes(groups[-1:])
