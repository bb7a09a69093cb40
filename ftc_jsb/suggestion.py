"""What somebody may have meant who wrote a name that is not known."""

import difflib
from collections.abc import Iterable

# Other words for keys of our files, which no likeness of letters would find.
SYNONYMS = {
    "begin": "start", "onset": "start", "from": "start", "t0": "start", "since": "start",
    "stop": "end", "finish": "end", "until": "end", "to": "end",
    "speed": "airspeed", "velocity": "airspeed", "tas": "airspeed",
    "height": "altitude", "alt": "altitude",
    "type": "kind", "channel": "target", "component": "target",
    "loss": "effectiveness", "factor": "effectiveness", "efficiency": "effectiveness",
    "magnitude": "size", "length": "duration", "time": "duration", "plane": "aircraft", "gain": "gains",
    "frequency": "rate", "hz": "rate", "controller": "loop", "faults": "fault", "failure": "fault",
    "gusts": "gust", "turb": "turbulence", "course": "heading_deg", "gamma": "flight_path_deg",
    "runs": "cases", "samples": "cases", "scenario": "scenarios", "model": "models", "loop": "loops",
}  # fmt: skip


def meant(word: str, *known: Iterable[str]) -> str | None:
    """The known name nearest to `word`; None if none is near.

    Args:
        word: as written.
        known: names, those that are more likely first.
    """
    lower = word.lower()
    groups = [{name.lower(): name for name in names} for names in known]
    for names in groups[:1]:
        if SYNONYMS.get(lower) in names:
            return names[SYNONYMS[lower]]
    for cutoff, names in zip((0.6, 0.75, 0.75), groups, strict=False):
        near = difflib.get_close_matches(lower, list(names), n=1, cutoff=cutoff)
        if near:
            return names[near[0]]
    return None


def did_you_mean(word: str, *known: Iterable[str]) -> str:
    """` (did you mean 'start'?)`, or nothing; as `meant`."""
    found = meant(word, *known)
    return "" if found is None else f" (did you mean {found!r}?)"
