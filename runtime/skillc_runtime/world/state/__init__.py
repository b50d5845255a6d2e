"""The world model: immutable versions, transactions, axioms and evidence. Start at `world_state`, then `model`."""
