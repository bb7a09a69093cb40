"""Links that are right in the repository are right in the site; what they lead to outside of docs/ joins it."""

import posixpath
import re
from pathlib import Path

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page

ROOT = Path(__file__).parents[2]
LINK = re.compile(r"(?<=\]\()([^)#:\s]+)(?=[#)])")
NOTEBOOKS = {f"docs/{path.name}": f"{path.stem}.md" for path in ROOT.glob("docs/*.py")}
ADDED = {  # path in the repository: path in the site's sources
    "CHANGELOG.md": "project/changelog.md",
    "CONTRIBUTING.md": "project/contributing.md",
    "CITATION.cff": "project/CITATION.cff",
    "LICENSE": "project/LICENSE",
    **{
        path.relative_to(ROOT).as_posix(): path.relative_to(ROOT).as_posix()
        for path in sorted(ROOT.glob("scenarios/**/*.toml"))
    },
}
ORIGINS = {target: origin for origin, target in ADDED.items()}


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """MkDocs' hook: the files join those of the site."""
    for origin, target in ADDED.items():
        files.append(File.generated(config, target, abs_src_path=str(ROOT / origin)))
    return files


def on_page_markdown(markdown: str, page: Page, **_: object) -> str:
    """MkDocs' hook: links go by where a file is in the repository, and come out by where it is in the site."""
    source = page.file.src_uri
    here = posixpath.dirname(ORIGINS.get(source, f"docs/{source}"))

    def moved(link: re.Match[str]) -> str:
        named = posixpath.normpath(posixpath.join(here, link[1]))
        target = (ADDED | NOTEBOOKS).get(named, named.removeprefix("docs/"))
        return posixpath.relpath(target, posixpath.dirname(source) or ".")

    return LINK.sub(moved, markdown)
