"""Devices as the skills see them: arms, grippers, bases, and the seams to what drives them."""
