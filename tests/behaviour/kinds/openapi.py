"""The OpenAPI document of a server."""

from __future__ import annotations

import json
from pathlib import Path

from behaviour.kinds._serving import serving
from behaviour.product import Product, write

SIMULATES = False


def save(product: Product, folder: Path) -> None:
    """Ask a server for its document."""
    with serving(product) as server:
        write(folder / "openapi.json", json.dumps(server.get("/openapi.json"), indent=1, sort_keys=True))
