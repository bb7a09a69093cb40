"""The paper's Figures 1 and 2, and the tracking errors: variables over time."""

from matplotlib.figure import Figure

from ftc_jsb.analysis.tracking import ERROR_NAMES
from ftc_jsb.report.figures.panels import panels
from ftc_jsb.report.flight_groups import Flights
from ftc_jsb.vocabulary.channels import TRACKED
from ftc_jsb.vocabulary.quantities import QUANTITIES, Quantity


def states(flights: Flights, wide: float | None = None) -> Figure:
    """Figure 1: airspeed, flight path angle and heading with their references."""
    return panels(flights, _labelled(TRACKED), reference=True, wide=wide)


def tracking(flights: Flights, wide: float | None = None) -> Figure:
    """Tracking errors: airspeed, flight path angle and heading minus their references."""
    return panels(flights, _labelled(ERROR_NAMES), reference=False, wide=wide)


def controls(flights: Flights, wide: float | None = None) -> Figure:
    """Figure 2: commanded thrust, and load factor and bank angle as flown."""
    thrust = QUANTITIES["thrust_cmd"]
    rows = {thrust.short_axis_label: thrust, **_labelled(("load_factor", "bank_angle"))}
    return panels(flights, rows, reference=False, wide=wide)


def _labelled(names: tuple[str, ...]) -> dict[str, Quantity]:
    return {QUANTITIES[name].axis_label: QUANTITIES[name] for name in names}
