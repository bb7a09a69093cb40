"""Whose fault is it? How often isolation is right, late, wrong, and how near the estimate is to its bound."""
