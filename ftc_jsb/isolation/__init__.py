"""Whose fault it is: analytic redundancy among instruments and thrust, hypotheses, decisions."""
