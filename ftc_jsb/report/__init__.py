"""What a reader sees of flights: the HTML page (page/), print figures (figures/), terminal tables (terminal/).

Beside the three stands what they share: findings, titles, verdicts, which metrics are shown.
"""
