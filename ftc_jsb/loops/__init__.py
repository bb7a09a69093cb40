"""Outer loops by name: the built-in ones and their settings, and the user's own."""
