"""Makes self-contained HTML pages of one style from templates that extend `base.html.j2`."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

from jinja2 import Environment

from skillc_model.templates import open_templates


def make_page(template: Path, **values: Any) -> str:
    """Return the page that a template makes of values."""
    return _open(template.parent).get_template(template.name).render(**values)


@cache
def _open(folder: Path) -> Environment:
    return open_templates(folder, Path(__file__).parent, is_html=True)
