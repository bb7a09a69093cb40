"""Reference pages of every key of scenario and campaign files, made from the models that check the files."""

from typing import Any

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files

from ftc_jsb.campaign.schema import Campaign
from ftc_jsb.file_schema import json_schema
from ftc_jsb.scenario.schema import Scenario

HEAD = "| key | values | default | |\n|---|---|---|---|\n"
PAGES = {
    "reference/scenario-keys.md": (
        Scenario,
        "Scenario keys",
        "Every key of a scenario file, as the program itself checks it. What they mean together is in "
        "[scenarios](../scenarios.md).",
    ),
    "reference/campaign-keys.md": (
        Campaign,
        "Campaign keys",
        "Every key of a campaign file, as the program itself checks it. What they mean together is in "
        "[campaigns](../campaigns.md).",
    ),
}

Schema = dict[str, Any]


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """MkDocs' hook: the pages join the files of the site."""
    for path, (model, title, text) in PAGES.items():
        page = f"# {title}\n\n{text}\n\n{_tables(json_schema(model, title))}"
        files.append(File.generated(config, path, content=page))
    return files


def _tables(schema: Schema) -> str:
    """A table of the keys at the top, then one for each section below it."""
    found: list[str] = [f"## Top\n\n{HEAD}"]
    _section(schema, schema["properties"], schema.get("required", []), "", found)
    return "\n".join(found)


def _section(
    schema: Schema, keys: Schema, required: list[str], prefix: str, found: list[str]
) -> None:
    """Rows of a section, then the sections below it. One that many keys share has its own table once."""
    place = len(found) - 1
    for name, key in keys.items():
        kind, many = _kind(key)
        reference = kind.get("$ref", "").rpartition("/")[2]
        link = f"{prefix}{name}{'[]' if many else ''}"
        if not reference:
            found[place] += _row(f"`{prefix}{name}`", key, name in required)
            continue
        below = schema["$defs"][reference]
        title = "sensors.SIGNAL" if reference == "Sensor" else link
        heading = f"## {title}\n"
        found[place] += f"| `{link}` | [section](#{_anchor(title)}) | | {_meaning(key)} |\n"
        if any(part.startswith(heading) for part in found):
            continue
        found.append(f"{heading}\n{_plain(below.get('description', ''))}\n\n{HEAD}")
        _section(schema, below["properties"], below.get("required", []), f"{title}.", found)


def _row(name: str, key: Schema, required: bool) -> str:
    default = "required" if required else _default(key.get("default"))
    return f"| {name} | {_values(_kind(key)[0] if 'anyOf' in key else key)} | {default} | {_meaning(key)} |\n"


def _kind(key: Schema) -> tuple[Schema, bool]:
    """The part of a key that is not null, or the items of a list of sections; whether it is such a list."""
    parts = [part for part in key.get("anyOf", []) if part.get("type") != "null"]
    kind = parts[0] if len(parts) == 1 else key
    if "$ref" in kind.get("items", {}):
        return kind["items"], True
    return kind, False


def _values(kind: Schema) -> str:
    """What a key may be, in words."""
    if "anyOf" in kind:
        parts = [_values(part) for part in kind["anyOf"] if part.get("type") != "null"]
        return " or ".join(dict.fromkeys(parts))
    if "enum" in kind:
        return ", ".join(f"`{value}`" for value in kind["enum"])
    if "const" in kind:
        return f"`{kind['const']}`"
    if "prefixItems" in kind:
        return (
            f"[{', '.join(_values(item).removeprefix('number, ') for item in kind['prefixItems'])}]"
        )
    if kind.get("type") == "array":
        return f"list of {_values(kind.get('items', {})) or 'values'}"
    if kind.get("type") in ("number", "integer"):
        return f"{'integer' if kind['type'] == 'integer' else 'number'}{_range(kind)}"
    return {"boolean": "`true`, `false`", "string": "text", "object": "table"}.get(
        kind.get("type", ""), "any value"
    )


def _range(kind: Schema) -> str:
    low = kind.get("minimum", kind.get("exclusiveMinimum"))
    high = kind.get("maximum", kind.get("exclusiveMaximum"))
    if low is None and high is None:
        return ""
    above = "more than " if "exclusiveMinimum" in kind else ""
    below = "less than " if "exclusiveMaximum" in kind else ""
    if high is None:
        return f", {above or 'at least '}{_number(low)}"
    if low is None:
        return f", {below or 'at most '}{_number(high)}"
    return f", {above}{_number(low)} to {below}{_number(high)}"


def _number(value: float) -> str:
    return str(int(value)) if float(value).is_integer() and abs(value) < 1e10 else f"{value:g}"


def _default(value: Any) -> str:
    if value is None or value in ("", {}):
        return "–"
    if isinstance(value, str):
        return f"`{value}`"
    if isinstance(value, bool):
        return f"`{str(value).lower()}`"
    if isinstance(value, list):
        return f"[{', '.join(_default(item) for item in value)}]"
    return _number(value)


def _meaning(key: Schema) -> str:
    return _plain(key.get("description", "")).replace("|", "\\|").rstrip(":")


def _plain(text: str) -> str:
    """A text in which no bracket is taken for a link."""
    return text.replace("[", "\\[").replace("]", "\\]")


def _anchor(title: str) -> str:
    """As the table of contents makes it from a heading."""
    return "".join(letter for letter in title.lower() if letter.isalnum() or letter in "_-")
