"""The files of the studio, a page that needs no token: it gets what it shows by the API, as who has logged in."""

from __future__ import annotations

import asyncio
import gzip
from dataclasses import dataclass, field
from http import HTTPStatus
from pathlib import Path
from secrets import token_urlsafe

from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import HTMLResponse, Response

STUDIO_FILES = Path(__file__).parents[1] / "studio_files"
INDEX, ASSETS = "index.html", "assets"
NONCE = "__NONCE__"
"""What the page has in the place of the nonce for the styles that its scripts add."""
POLICY = "; ".join(
    (
        "default-src 'none'",
        "script-src 'self'",
        f"style-src 'self' 'nonce-{NONCE}'",
        "connect-src 'self'",
        "img-src 'self' data: blob:",
        "font-src 'self'",
        "worker-src 'self'",
        "frame-ancestors 'none'",
        "base-uri 'none'",
        "form-action 'none'",
    )
)
MEDIA_TYPES = {
    ".css": "text/css",
    ".js": "text/javascript",
    ".json": "application/json",
    ".png": "image/png",
    ".svg": "image/svg+xml",
    ".txt": "text/plain",
    ".wasm": "application/wasm",
    ".woff2": "font/woff2",
}
COMPRESSED = ".gz"
"""How the names of files end that the build has compressed."""
NOT_BUILT = """<!doctype html>
<html lang="en"><meta charset="utf-8"><title>skillc studio</title>
<h1>The studio is not built</h1>
<p>This server runs from a checkout without the files of the studio. <code>make studio</code> builds them; it needs
Node. Then load this page again. The API and the command line work without it.</p>
</html>
"""


@dataclass(frozen=True, slots=True)
class Asset:
    """A file, also compressed if the build has done that."""

    content: bytes
    compressed: bytes | None
    media_type: str


@dataclass(slots=True)
class StudioPage:
    """The page and its assets in a folder; they are read when they are first wanted, and again once they are built."""

    folder: Path
    _built_ns: int = 0
    _assets: dict[str, Asset] = field(default_factory=dict)

    async def show_page(self, _: Request) -> Response:
        """Return the page, which may load from this server alone; without built files one that says how to build it."""
        try:
            text = await asyncio.to_thread((self.folder / INDEX).read_text, encoding="utf-8")
        except OSError:
            text = NOT_BUILT
        nonce = token_urlsafe(16)
        return HTMLResponse(text.replace(NONCE, nonce), headers=_make_headers("no-store", nonce))

    async def show_asset(self, request: Request) -> Response:
        """Return a file of the page, which browsers may keep: its name changes with its content."""
        await asyncio.to_thread(self._read)
        found = self._assets.get(request.path_params["path"])
        if found is None:
            raise HTTPException(HTTPStatus.NOT_FOUND)
        headers = _make_headers("public, max-age=31536000, immutable", "") | {"Vary": "Accept-Encoding"}
        if found.compressed is not None and "gzip" in request.headers.get("accept-encoding", ""):
            return Response(
                found.compressed, headers=headers | {"Content-Encoding": "gzip"}, media_type=found.media_type
            )
        return Response(found.content, headers=headers, media_type=found.media_type)

    def _read(self) -> None:
        """Read all assets if there are others than before, so that a request names one of them, and no path."""
        try:
            built_ns = (self.folder / INDEX).stat().st_mtime_ns
        except OSError:
            built_ns = 0
        if built_ns != self._built_ns:
            root = self.folder / ASSETS
            files = (each for each in root.rglob("*") if each.is_file())
            self._assets = {
                each.relative_to(root).as_posix().removesuffix(COMPRESSED): _read_asset(each) for each in files
            }
            self._built_ns = built_ns


def _read_asset(file: Path) -> Asset:
    written, compressed = file.read_bytes(), file.suffix == COMPRESSED
    name = Path(file.stem) if compressed else file
    media_type = MEDIA_TYPES.get(name.suffix, "application/octet-stream")
    return Asset(gzip.decompress(written), written, media_type) if compressed else Asset(written, None, media_type)


def _make_headers(cache: str, nonce: str) -> dict[str, str]:
    return {
        "Cache-Control": cache,
        "Content-Security-Policy": POLICY.replace(NONCE, nonce),
        "Cross-Origin-Opener-Policy": "same-origin",
        "Cross-Origin-Resource-Policy": "same-origin",
        "Referrer-Policy": "no-referrer",
        "X-Content-Type-Options": "nosniff",
    }
