"""Makes a project of a domain and a problem in PDDL: what they declare in the language, and what it cannot say, noted.

Start at `importing.import_pddl`.
"""
