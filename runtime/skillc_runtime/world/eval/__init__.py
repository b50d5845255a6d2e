"""Evaluates conditions, expressions and effects of skills in a version of the world, and explains the results.

`conditions` and `expressions` evaluate; `explain` and `grounds` give reasons; `inference` binds parameters. Start at
`conditions`.
"""
