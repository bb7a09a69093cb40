"""The numbers of an aircraft's inner loop as the JSBSim system `aircraft/NAME/inner_loop.xml`."""

from pathlib import Path
from typing import NamedTuple

from ftc_jsb.inner_loop_design.airframe import Airframe
from ftc_jsb.six_dof.weaving.numbers import system_name

HEADER = """<?xml version="1.0"?>
<!-- Made by `{command}` with jsbsim {jsbsim}: the numbers that ftc_jsb/six_dof/weaving/inner_loop_structure.xml
     reads for this aircraft. docs/aircraft.md says how they are found. -->
<system name="{name}">
"""


class References(NamedTuple):
    """Second-order references that load factor and bank follow."""

    load_factor_frequency: float  # [rad/s]
    load_factor_damping: float
    bank_frequency: float  # [rad/s]
    bank_damping: float


class Gains(NamedTuple):
    """Feedback [1/s]: `design.gains`."""

    load_factor: float
    load_factor_integral: float
    bank: float
    sideslip: float
    rate: float
    inversion: float
    full_pressure: float  # [psf], from which load factor is fed back in full


def feedback(gains: Gains) -> list[tuple[str, float]]:
    """The gains [1/s] by name."""
    return [(name, value) for name, value in gains._asdict().items() if name != "full_pressure"]


def write_numbers(
    path: Path,
    command: str,
    model: str,
    airframe: Airframe,
    references: References,
    gains: Gains,
    load_factor: tuple[float, float],
) -> None:
    """Write `inner_loop.xml`.

    Args:
        path: of the file.
        command: that makes it, for the header.
        model: the JSBSim aircraft that it is for.
        airframe: as measured.
        references: as searched for.
        gains: of the feedback.
        load_factor: limits of the command.
    """
    import jsbsim

    lines = [HEADER.format(command=command, jsbsim=jsbsim.__version__, name=system_name(model))]
    lines += ["  <!-- Reference models: frequency [rad/s], damping; load factor limits -->"]
    lines += [
        _constant("load-factor/frequency", references.load_factor_frequency),
        _constant("load-factor/damping", references.load_factor_damping),
        _constant("bank/frequency", references.bank_frequency),
        _constant("bank/damping", references.bank_damping),
        _constant("load-factor/min", load_factor[0]),
        _constant("load-factor/max", load_factor[1]),
        "",
        "  <!-- Feedback of load factor, its integral, bank, sideslip, body rates; inversion bandwidth",
        "       [1/s]; dynamic pressure from which load factor is fed back in full [psf] -->",
    ]
    lines += [_constant(f"gain/{name.replace('_', '-')}", value) for name, value in feedback(gains)]
    lines += [_constant("load-factor/full-gain-psf", gains.full_pressure)]
    lines += ["", "  <!-- Surface rates [1/s] of a command that goes from -1 to 1 -->"]
    lines += [_constant(f"airframe/{name}-rate", value) for name, value in airframe.rate.items()]
    lines += [
        "",
        "  <!-- Over Mach: lift slope [1/rad]; angular acceleration of a unit command for a unit dynamic",
        "       pressure [rad/s2/psf]; roll rate that the bank reference may ask for [rad/s] -->",
        '  <channel name="airframe">',
        _table("airframe/lift-slope", airframe.mach, airframe.lift_slope),
    ]
    lines += [
        _table(f"airframe/{name}", airframe.mach, values)
        for name, values in airframe.effectiveness.items()
    ]
    lines += [
        _table("bank/rate-max", airframe.mach, airframe.roll_rate),
        "  </channel>",
        "</system>",
    ]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def _constant(name: str, value: float) -> str:
    return f'  <property value="{value:.4g}">ftc/{name}</property>'


def _table(name: str, mach: tuple[float, ...], values: tuple[float, ...]) -> str:
    rows = "\n".join(f"        {m:.2f}  {v:.4g}" for m, v in zip(mach, values, strict=True))
    return (
        f'    <fcs_function name="ftc/{name}">\n'
        "      <function><table><independentVar>velocities/mach</independentVar><tableData>\n"
        f"{rows}\n"
        "      </tableData></table></function>\n"
        "    </fcs_function>"
    )
