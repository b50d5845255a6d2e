"""Functions over arrays that run a thousand times a second: compiled where numba is installed.

Start at `compiled.compiled`; `linear` selects the linear algebra.
"""
