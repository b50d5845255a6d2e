"""Fuzzers: random input of one kind each, through the real product; `python -m fuzz KIND`, or `make fuzz`.

A kind is a module in `kinds/`: `run_case(random, folder)` makes one input, writes it into `folder`, and raises when the
product breaks a promise. `runner.py` gives each case its seed, its time limit and a process that may die.
"""
