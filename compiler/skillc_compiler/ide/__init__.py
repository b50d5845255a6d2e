"""Editor features as pure functions over an analysed library, independent of any protocol. Start at `analysis`."""
