"""From text to syntax tree: tokens, repairs, the parser's loop with its recovery, and what builds the tree.

Start at `parser.parse`, which shows the passes in order.
"""
