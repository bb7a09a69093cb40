"""Classes of airplanes as MIL-F-8785C 1.3 has them, by mass and load factor."""

from typing import Literal

AirplaneClass = Literal["I", "II", "III", "IV"]

AGILE = 5.5  # load factor from which an airplane counts as highly manoeuvrable
LIGHT = 5700.0  # [kg], 12 500 lb, up to which it counts as small and light
HEAVY = 45000.0  # [kg], 100 000 lb, from which it counts as large and heavy


def airplane_class(mass: float, load_factor_max: float) -> AirplaneClass:
    """I small and light, II medium, III large and heavy, IV highly manoeuvrable.

    Args:
        mass: [kg], with half of the internal fuel.
        load_factor_max: that the aircraft is flown to.
    """
    if load_factor_max >= AGILE:
        return "IV"
    if mass <= LIGHT:
        return "I"
    return "III" if mass >= HEAVY else "II"
