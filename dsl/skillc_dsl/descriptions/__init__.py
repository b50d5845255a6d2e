"""What there is in the language: one row a declaration, member, flag, condition form and node.

Grammar, tokens, highlighters, formatter, help, the reference, pictures and trees for BehaviorTree.CPP are made of them.
"""
