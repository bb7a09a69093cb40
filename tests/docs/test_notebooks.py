"""The notebooks of the documentation run from top to bottom, in a minute, and show what they draw."""

from pathlib import Path
from time import monotonic

import jupytext
import pytest
from nbclient import NotebookClient

DOCS = Path(__file__).parents[2] / "docs"
NOTEBOOKS = [DOCS / "tutorial.py", DOCS / "validity.py"]
LONGEST = 60.0  # [s], of what a reader is promised to take ten minutes with reading


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs(path, tmp_path):
    """In an empty folder, where it leaves nothing: a page that writes would fail a reader the second time."""
    notebook = jupytext.read(path)
    resources = {"metadata": {"path": str(tmp_path)}}
    start = monotonic()
    NotebookClient(notebook, timeout=LONGEST, kernel_name="python3", resources=resources).execute()
    assert monotonic() - start < LONGEST
    assert not list(tmp_path.iterdir())
    cells = [
        cell for cell in notebook.cells if ".plot(" in cell.source and cell.cell_type == "code"
    ]
    assert all(
        any("image/png" in shown.get("data", {}) for shown in cell.outputs) for cell in cells
    )
