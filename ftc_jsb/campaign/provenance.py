"""With what a campaign is flown: rows of two versions of the program are not of one campaign."""

import hashlib
import json
from functools import cache

from ftc_jsb.recording.provenance import versions
from ftc_jsb.resources import shipped
from ftc_jsb.sources import source_digest

_AIRCRAFT_FILES = ("aircraft.toml", "inner_loop.xml", "point_mass.toml")


@cache
def code_digest() -> str:
    """SHA-256 of what decides a flight: sources, versions of packages, the shipped aircraft."""
    digest = hashlib.sha256(source_digest("ftc_jsb.campaign.flights").encode())
    digest.update(json.dumps(versions(), sort_keys=True).encode())
    for path in sorted(shipped("aircraft").glob("*/*")):
        if path.name in _AIRCRAFT_FILES:
            digest.update(path.name.encode() + path.read_bytes())
    return digest.hexdigest()
