"""Numbers with a sign as text."""

from __future__ import annotations


def format_signed(value: float, digits: int) -> str:
    """Return a number with its sign and so many digits; what rounds to zero has no sign: `0.0`."""
    return f"{value:+.{digits}f}" if abs(value) >= 0.5 * 10**-digits else f"{0.0:.{digits}f}"


def format_tilt(about_x_deg: float, about_y_deg: float) -> str:
    """Return tilts about two axes in degrees as the end of a list: `, tilted +0.3 and 0.0 deg`; empty if both are 0."""
    both = [format_signed(each, 1) for each in (about_x_deg, about_y_deg)]
    return "" if both == ["0.0", "0.0"] else f", tilted {' and '.join(both)} deg"
