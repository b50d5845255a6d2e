"""What conditions, expressions and effects of skills mean in a version of the world. Start at `conditions`."""
