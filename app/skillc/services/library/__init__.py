"""Skill libraries: their files, what they compile to, their ontologies, and what is cached of them."""
