"""Builders that convert parse trees to the syntax tree, one module for each module of `skillc_dsl.syntax`.

Start at `declarations.FileBuilder`.
"""
