"""The example of docs/theory.md runs."""

from pathlib import Path

import numpy as np


def test_example_of_the_theory_page_flies():
    """The loss of 0.7 at 5 s is told within 0.01 at the end."""
    page = (Path(__file__).parents[2] / "docs" / "theory.md").read_text()
    scope: dict[str, object] = {}
    exec(page.split("```python")[1].split("```")[0], scope)
    history = scope["history"]
    assert np.abs(history.estimate[-1, 2] - 0.7) < 0.01
