"""Diagnostics in various output formats, one module each: `full`, `concise`, `json`, `github`, `sarif`.

Start at `full.render`.
"""
