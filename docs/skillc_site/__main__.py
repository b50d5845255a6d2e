"""Builds the site into a folder: `python -m skillc_site [OUT]`."""

from __future__ import annotations

import sys
from pathlib import Path

from skillc_site.build import build_site

if __name__ == "__main__":
    sys.exit(build_site(Path(sys.argv[1] if len(sys.argv) > 1 else "out/site").resolve()))
