"""The systems that are shipped: the fighter by velocity, by position, and a textbook plant."""

from ftc_jsb.theory.systems.fighter import fighter_by_position, fighter_by_velocity
from ftc_jsb.theory.systems.textbook import textbook_plant

__all__ = ["fighter_by_position", "fighter_by_velocity", "textbook_plant"]
