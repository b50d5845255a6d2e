"""Diagnostics as text, each form on its page: `full` for people, `concise` for terminals, `json` for machines."""
