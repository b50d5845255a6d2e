"""Projects: a folder with a `skillc.toml`, which names its library, dependencies, ontologies and defaults.

Start reading at `project.py`; `manifest.py` has the contents of the file.
"""
