"""How evaluations are shown as pages: one frame with one style, and plots of dots. Start at `page`."""
