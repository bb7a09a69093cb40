"""Notebooks, which are Python files with cells, become pages: executed, with their outputs, and to download."""

import os
import re
from functools import cache
from pathlib import Path
from typing import Any

import jupytext
import nbformat
from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files
from nbclient import NotebookClient
from nbconvert import MarkdownExporter

DOCS = Path(__file__).parents[1]
NOTEBOOKS = tuple(sorted(DOCS.glob("*.py")))
EXECUTED = os.environ.get("FTC_JSB_EXECUTE_NOTEBOOKS", "true") == "true"
TIMEOUT = 300.0  # [s] of a cell; the first one may compile
DOWNLOAD = "To download: [notebook]({name}.ipynb), [Python]({name}.py).\n\n"
FRAME = re.compile(r'<style scoped>.*?</style>\s*|(?<=<table) border="1" class="dataframe"', re.S)


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """MkDocs' hook: pages, their pictures and the notebooks join the files of the site."""
    for path in NOTEBOOKS:
        page, pictures, notebook = _exported(path, path.read_text(encoding="utf-8"))
        files.append(File.generated(config, f"{path.stem}.md", content=page))
        files.append(File.generated(config, f"{path.stem}.ipynb", content=notebook))
        for name, data in pictures.items():
            files.append(File.generated(config, name, content=data))
    return files


@cache  # `mkdocs serve` builds after each change of any page
def _exported(path: Path, text: str) -> tuple[str, dict[str, bytes], str]:
    """The page in Markdown, its pictures by path, and the notebook with its outputs."""
    notebook: Any = jupytext.reads(text, fmt="py:percent")
    if EXECUTED:
        NotebookClient(notebook, timeout=TIMEOUT, kernel_name="python3").execute()
    page, resources = MarkdownExporter().from_notebook_node(
        notebook, {"unique_key": path.stem, "output_files_dir": "images"}
    )
    title, _, rest = page.strip().partition("\n")
    page = f"{title}\n\n{DOWNLOAD.format(name=path.stem)}{FRAME.sub('', rest)}"
    return page, dict(resources["outputs"]), nbformat.writes(notebook)
