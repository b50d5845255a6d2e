"""Films and stills of a simulated run: frames are sampled while it runs and drawn afterwards.

Start at `film.Film`; `looks` and its neighbours replace the shipped shapes by meshes of other collections.
"""
