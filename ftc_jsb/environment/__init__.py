"""`ftc_jsb/Track-v0` for Gymnasium: import this package to register it (docs/gymnasium.md)."""

from ftc_jsb.environment.track import ID as ID
from ftc_jsb.environment.track import Track as Track
from ftc_jsb.environment.track import register as register
from ftc_jsb.environment.vectors import COMPONENTS as COMPONENTS
from ftc_jsb.environment.vectors import action_command as action_command
from ftc_jsb.environment.vectors import action_ranges as action_ranges
from ftc_jsb.environment.vectors import observation as observation

register()
