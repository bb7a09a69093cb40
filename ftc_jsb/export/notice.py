"""What the files say of themselves that an exported aircraft derives from: authors and licences."""

import re
import textwrap
import xml.etree.ElementTree as ET
from collections.abc import Iterable
from pathlib import Path

_COMMENT = re.compile(r"<!--(.*?)-->", re.DOTALL)


def stated_header(path: Path) -> str:
    """Comments before the root element and the `<fileheader>` of an XML file, as text.

    Raises:
        xml.etree.ElementTree.ParseError, OSError: it cannot be read.
    """
    root = ET.fromstring(path.read_bytes())
    text = path.read_text(encoding="utf-8", errors="replace")
    start = re.search(rf"<{re.escape(root.tag)}\b", _COMMENT.sub(lambda c: " " * len(c[0]), text))
    lines = []
    for comment in _COMMENT.finditer(text, 0, start.start() if start else 0):
        lines += [" ".join(line.split()) for line in comment[1].splitlines()]
    for element in root.findall("fileheader/*"):
        said = " ".join([*" ".join(element.itertext()).split(), *element.attrib.values()])
        lines.append(f"{element.tag}: {said}")
    return "\n".join(line for line in lines if line)


def notice(
    changed: Iterable[tuple[str, Path]],
    copied: Iterable[tuple[str, Path]],
    versions: str,
    date: str,
) -> str:
    """The NOTICE of an export.

    Args:
        changed: name in the export and source of each file that was changed.
        copied: the same of each file that was copied.
        versions: of ftc-jsb and jsbsim.
        date: of the export.
    """
    parts = [
        "NOTICE",
        _filled(
            f"This aircraft was made by {versions} on {date} from files that the jsbsim package installs. "
            "They are not ftc-jsb's. What each says of its authors and its licence is quoted below. Where one "
            "names the GNU General Public License (the F-16 does, without a version), the aircraft as a "
            "whole is under it; where none is named, the terms are those of the jsbsim package, the GNU "
            "Lesser General Public License 2.1 or later (JSBSIM-LICENSE.txt), and the authors' own words. "
            "Whoever passes this folder on does so under these terms, with this notice."
        ),
        _filled(
            "ftc-jsb's own: scripts/, -set.xml, and all files whose names begin with ftc (the tables in "
            "ftc_engine_deck.xml are the engine's): BSD 3-Clause, which may be combined with the GPL."
        ),
        f"CHANGED on {date} by ftc-jsb",
        _filled(
            "Aircraft: systems added before <flight_control>; the corrections of aircraft.toml. "
            "Engines: an effectiveness factor in each thrust function. Comments were dropped."
        ),
        *_quoted(changed),
        "COPIED unchanged",
        *_quoted(copied),
    ]
    return "\n\n".join(parts) + "\n"


def _filled(text: str) -> str:
    return textwrap.fill(text, 100)


def _quoted(files: Iterable[tuple[str, Path]]) -> list[str]:
    quoted = []
    for name, source in files:
        header = stated_header(source) or "(names neither author nor licence)"
        quoted.append(f"{name}\n{textwrap.indent(header, '    ')}")
    return quoted or ["(none)"]
