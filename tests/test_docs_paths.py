"""Every file that the documents name is there."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PAGES = sorted([*ROOT.glob("*.md"), *ROOT.glob("docs/*.md"), *ROOT.glob("docs/howto/*.md")])
ROOMS = (ROOT, ROOT / "ftc_jsb", ROOT / "tests")  # what the short form of a path may start from
OURS = ("aircraft/", "docs/", "ftc_jsb/", "scenarios/", "tests/", "validation/")
PROGRAMS = {"mavproxy.py", "MAVExplorer.py", "mavlogdump.py"}  # of other projects
CODE = re.compile(r"`([\w./-]+)`")
LINK = re.compile(r"\]\(([^)#:\s]+)(?:#[^)]*)?\)")


def paths(line: str) -> list[str]:
    """What a line puts in backquotes that is a path of this project, placeholders left out."""
    return [
        text
        for text in CODE.findall(line)
        if (text.endswith(".py") or text.startswith(OURS))
        and text not in PROGRAMS
        and "NAME" not in text
        and not text.startswith("ftc_jsb/shipped/")  # in an installed package alone
    ]


def missing(page: str) -> list[str]:
    """Paths that lead nowhere. A bare name stands for a file beside the one named before it."""
    nowhere = []
    for line in re.sub(r"```.*?```", "", page, flags=re.DOTALL).splitlines():
        beside: list[Path] = []
        for text in paths(line):
            near = ROOMS if "/" in text else beside
            found = [room / text for room in near if (room / text).exists()]
            nowhere += [] if found else [text]
            beside = [path.parent for path in found] or beside
    return nowhere


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_paths_that_a_page_names_exist(page):
    assert not missing(page.read_text(encoding="utf-8"))


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_files_that_a_page_links_to_exist(page):
    linked = LINK.findall(page.read_text(encoding="utf-8"))
    assert not [link for link in linked if not (page.parent / link).exists()]


def test_a_path_that_leads_nowhere_is_seen():
    """The full and the short form, a name beside the one before it, and one that is elsewhere."""
    page = "`ftc_jsb/units.py` `control/law.py`, `path.py`, `ukf.py`; `control/lore.py` `my.toml`"
    assert missing(page) == ["ukf.py", "control/lore.py"]
