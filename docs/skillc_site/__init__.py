"""Builds the site of the documentation: `python -m skillc_site OUT` with `docs` on the path of Python; `make docs`.

`build.py` is the whole on one page. The site needs no network, neither when it is built nor when it is read.
"""
