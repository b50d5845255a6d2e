"""The parser: tokens, repairs, the parser loop with error recovery, and the builders of the syntax tree.

Start at `parser.parse`, which shows the passes in order.
"""
