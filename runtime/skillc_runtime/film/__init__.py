"""Films and stills of a simulated run: frames are sampled during the run and rendered afterwards.

Start with `film.Film`; `looks`, `look_cache` and `look_meshes` replace the shipped shapes by meshes of collections.
"""
