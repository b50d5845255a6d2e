"""The page of the studio and its files need no token, and nothing beside them is read."""

from __future__ import annotations

import asyncio
import gzip
import os
from pathlib import Path

import httpx
import pytest
from starlette.applications import Starlette
from starlette.routing import Route

from server.running import RunningServer
from skillc.server.studio_page import StudioPage

SCRIPT = "console.log('here');\n" * 100


def get(folder: Path, *paths: str, encoding: str = "identity") -> list[httpx.Response]:
    """Return the answers to requests, one after the other, of a server whose studio is in a folder."""
    page = StudioPage(folder)
    app = Starlette(routes=[Route("/", page.show_page), Route("/assets/{path:path}", page.show_asset)])

    async def ask() -> list[httpx.Response]:
        transport = httpx.ASGITransport(app)
        async with httpx.AsyncClient(transport=transport, base_url="http://here") as client:
            return [await client.get(each, headers={"Accept-Encoding": encoding}) for each in paths]

    return asyncio.run(ask())


@pytest.fixture
def built(tmp_path: Path) -> Path:
    folder = tmp_path / "studio_files"
    (folder / "assets" / "fonts").mkdir(parents=True)
    (folder / "index.html").write_text('<meta name="csp-nonce" content="__NONCE__"><script src="/assets/a.js">')
    (folder / "assets" / "a.js.gz").write_bytes(gzip.compress(SCRIPT.encode(), 9, mtime=0))
    (folder / "assets" / "fonts" / "f.woff2").write_bytes(os.urandom(2000))
    (tmp_path / "secret.js").write_text("secret")
    return folder


def test_the_page_may_load_from_its_server_alone(built: Path) -> None:
    first, second = get(built, "/", "/")
    policy = first.headers["content-security-policy"]
    nonce = first.text.partition('content="')[2].partition('"')[0]
    assert f"style-src 'self' 'nonce-{nonce}'" in policy and len(nonce) > 20 and first.text != second.text
    assert {"default-src 'none'", "script-src 'self'", "connect-src 'self'", "frame-ancestors 'none'"} <= {
        *policy.split("; ")
    }
    assert "unsafe" not in policy and first.headers["cache-control"] == "no-store"
    assert (first.headers["x-content-type-options"], first.headers["referrer-policy"]) == ("nosniff", "no-referrer")


def test_assets_are_compressed_for_who_takes_that_and_kept(built: Path) -> None:
    (plain,) = get(built, "/assets/a.js")
    (small,) = get(built, "/assets/a.js", encoding="gzip")
    assert plain.text == small.text == SCRIPT and "content-encoding" not in plain.headers
    assert small.headers["content-encoding"] == "gzip"
    assert int(small.headers["content-length"]) == len(gzip.compress(SCRIPT.encode(), 9)) < len(SCRIPT)
    assert plain.headers["content-type"].startswith("text/javascript") and "immutable" in plain.headers["cache-control"]
    (font,) = get(built, "/assets/fonts/f.woff2", encoding="gzip")
    assert font.headers["content-type"] == "font/woff2" and "content-encoding" not in font.headers


def test_what_is_built_again_is_served(built: Path) -> None:
    page = StudioPage(built)
    app = Starlette(routes=[Route("/assets/{path:path}", page.show_asset)])

    async def ask() -> list[int]:
        async with httpx.AsyncClient(transport=httpx.ASGITransport(app), base_url="http://here") as client:
            first = await client.get("/assets/b.js")
            (built / "assets" / "b.js").write_text("b")
            os.utime(built / "index.html", ns=(1, 1))
            return [first.status_code, (await client.get("/assets/b.js")).status_code]

    assert asyncio.run(ask()) == [404, 200]


@pytest.mark.parametrize(
    "path", ["../index.html", "..%2f..%2fsecret.js", "%2e%2e/%2e%2e/secret.js", "/etc/passwd", "a.js%00", "", "fonts"]
)
def test_nothing_else_is_read(built: Path, path: str) -> None:
    assert [each.status_code for each in get(built, f"/assets/{path}")] == [404]


def test_without_built_files_the_page_says_how_to_build_them(tmp_path: Path) -> None:
    page, asset = get(tmp_path / "nowhere", "/", "/assets/a.js")
    assert "make studio" in page.text and "content-security-policy" in page.headers and asset.status_code == 404


def test_a_server_has_the_page_for_its_own_names_only(server: RunningServer) -> None:
    address = server.url.removesuffix("/api/v1")
    assert "skillc" in httpx.get(address).text
    assert httpx.get(address, headers={"Host": "evil.example"}).status_code == 421
    missing = httpx.get(f"{address}/assets/none.js")
    assert (missing.status_code, missing.headers["content-type"]) == (404, "application/problem+json")
    assert httpx.get(f"{address}/elsewhere").status_code == 404
