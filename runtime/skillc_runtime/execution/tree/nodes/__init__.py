"""The nodes of bodies: sequences, selectors, loops, decorators, leaves."""
