"""Executes plans: bodies that run their steps, progress, and which steps have failed.

Start at `plan_body.build_plan_body`.
"""
