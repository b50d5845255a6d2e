"""The page has the types of the server that it talks to."""

from __future__ import annotations

import subprocess
from pathlib import Path

import msgspec
import pytest

from docs.pages import ROOT
from skillc.contract.api.endpoint import PREFIX
from skillc.contract.api.endpoints import ENDPOINTS
from skillc.server.http.openapi import make_openapi
from waiting import LONG_S

STUDIO = ROOT / "studio"


def test_its_types_are_those_of_the_document(tmp_path: Path) -> None:
    if not (STUDIO / "node_modules").is_dir():
        pytest.skip("the packages of the studio are not installed, `make studio` does it")
    document = msgspec.json.encode(make_openapi(ENDPOINTS, PREFIX))
    made = tmp_path / "schema.ts"
    subprocess.run(("node", "make_types.mjs", str(made)), cwd=STUDIO, input=document, check=True, timeout=LONG_S)
    told = "pipe /api/v1/openapi.json of a server into `npm run types`"
    assert made.read_text("utf-8") == (STUDIO / "src/api/schema.ts").read_text("utf-8"), told
