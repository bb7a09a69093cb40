"""Command filter, law, outer loops and their registry."""
