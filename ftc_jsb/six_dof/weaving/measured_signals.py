"""An inner loop that reads its sensors: measured properties in place of the true ones.

A measured property is the true one, which moves from frame to frame, plus the error that the sensor had at the
outer loop's last sample.
"""

# True property: property of the measured one, and of the error that the plant writes.
MEASURED = {
    name: (f"ftc/measured/{name.split('/')[1]}", f"ftc/error/{name.split('/')[1]}")
    for name in (
        "velocities/vt-fps",
        "aero/alpha-rad",
        "aero/beta-rad",
        "attitude/phi-rad",
        "attitude/theta-rad",
        "velocities/p-rad_sec",
        "velocities/q-rad_sec",
        "velocities/r-rad_sec",
        "accelerations/Nx",
        "accelerations/Ny",
        "accelerations/Nz",
        "accelerations/pdot-rad_sec2",
        "accelerations/qdot-rad_sec2",
        "accelerations/rdot-rad_sec2",
    )
}
PRESSURE = ("aero/qbar-psf", "ftc/measured/qbar-psf")  # of the measured airspeed
FIRST_CHANNEL = '  <channel name="flight condition">'


def measured_structure(structure: str) -> str:
    """The inner loop's structure, reading measured properties.

    Args:
        structure: XML text of `inner_loop_structure.xml`.
    """
    for true, (measured, _) in (*MEASURED.items(), (PRESSURE[0], (PRESSURE[1], ""))):
        structure = structure.replace(f"<p>{true}</p>", f"<p>{measured}</p>")
    head, first, rest = structure.partition(FIRST_CHANNEL)
    errors = "".join(
        f'  <property value="0">{error}</property>\n' for _, error in MEASURED.values()
    )
    return f"{head}{errors}\n{_measuring_channel()}\n{first}{rest}"


def _measuring_channel() -> str:
    sums = "".join(
        f'    <fcs_function name="{measured}"><function>'
        f"<sum><p>{true}</p><p>{error}</p></sum></function></fcs_function>\n"
        for true, (measured, error) in MEASURED.items()
    )
    true, (measured, _) = next(iter(MEASURED.items()))
    ratio = f"<quotient><p>{measured}</p><max><p>{true}</p><v>1</v></max></quotient>"
    pressure = f"<product><p>{PRESSURE[0]}</p><pow>{ratio}<v>2</v></pow></product>"
    return (
        f'  <channel name="sensors">\n{sums}'
        f'    <fcs_function name="{PRESSURE[1]}"><function>{pressure}</function></fcs_function>\n'
        "  </channel>\n"
    )
