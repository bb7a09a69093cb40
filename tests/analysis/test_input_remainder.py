"""The remainder of the paper's approximation along a real flight of its fighter."""

import numpy as np

from ftc_jsb.analysis.input_remainder import flight_remainder


def test_remainder_falls_with_zeta_and_beats_the_delayed_input(flown):
    """Proposition 4 along the paper's flight: max ||O|| falls with zeta (Remark 5, 5 to 50 1/s).

    (10) at zeta = 50 is a lag of 0.02 s; the delayed input u(t - 0.02) has a remainder of like size,
    u(t - 0.2) a far larger one.
    """
    sizes = [
        flight_remainder(flown("paper", f"loop.trim_filter={zeta}")).max()
        for zeta in (5, 10, 20, 50)
    ]
    assert sizes == sorted(sizes, reverse=True)
    assert sizes[-1] < 0.05 * sizes[0]
    flight = flown("paper")
    assert flight_remainder(flight, delay=0.2).max() > 10.0 * sizes[-1]
    assert np.isfinite(flight_remainder(flight, delay=0.02)).all()
