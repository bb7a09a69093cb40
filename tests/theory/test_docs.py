"""The examples of docs/theory.md run."""

from pathlib import Path

import numpy as np

EXAMPLES = (Path(__file__).parents[2] / "docs" / "theory.md").read_text().split("```python")[1:]


def test_example_of_the_theory_page_flies():
    """The loss of 0.7 at 5 s is told within 0.01 at the end."""
    scope: dict[str, object] = {}
    exec(EXAMPLES[1].split("```")[0], scope)
    history = scope["history"]
    assert np.abs(history.estimate[-1, 2] - 0.7) < 0.01
