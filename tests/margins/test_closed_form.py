"""The measuring method where theory gives the loop transfer function, on point masses.

Each channel of the law is K_c over an integrator with commands held over a sample; the aircraft's lag and
the lead against it, and the filter's estimate, come to it.
"""

import numpy as np
import pytest
from scipy.linalg import solve_discrete_are
from scipy.signal import cont2discrete

from ftc_jsb.control.law import airspeed_row
from ftc_jsb.margins.classical import classical_margins
from ftc_jsb.margins.condition import level_scenario
from ftc_jsb.margins.frequency_response import FrequencyResponse
from ftc_jsb.margins.measure import AMPLITUDE, delay_margin, frequency_response, gain_margin
from ftc_jsb.point_mass.model import at_condition
from ftc_jsb.scenario.schema import Scenario
from ftc_jsb.simulation.assembly import point_mass_of
from ftc_jsb.simulation.fly import fly

DT = 0.01  # [s]
NO_INTEGRAL = {"name": "integral", "integral_gains": (0.0, 0.0, 0.0)}


def level(aircraft: str, model: str, **loop: object) -> Scenario:
    scenario = level_scenario(aircraft, model)
    return scenario.model_copy(update={"loop": scenario.loop.model_copy(update=loop)})


def trim_of(scenario: Scenario) -> tuple[float, float, float, float]:
    """Mass [kg], dF/dV [N s/m], dF/dT and thrust [N] of level trim, F the force along the path."""
    model = point_mass_of(scenario).record(scenario.aircraft.fuel_fraction)
    airspeed, altitude = scenario.initial.airspeed, scenario.initial.altitude
    settled = fly(scenario.model_copy(update={"duration": 20.0})).record
    thrust = float(settled["thrust_cmd"][-2])

    def force(speed: float) -> tuple[float, float]:
        return airspeed_row(at_condition(model[0], speed, altitude), speed, thrust, 1.0)[:2]

    slope = (force(airspeed + 0.5)[0] - force(airspeed - 0.5)[0]) / 1.0  # [m/s] between them
    return float(model[0]["mass"]), slope, force(airspeed)[1], thrust


def assert_same(
    measured: FrequencyResponse, theory: np.ndarray, size: float, angle: float, below: float = 400.0
) -> None:
    """Relative size, and phase [deg], at lines below a frequency [rad/s]; L above -60 dB."""
    ratio = measured.loop / theory
    heard = (np.abs(theory) > 1e-3) & (measured.frequency < below)
    assert heard.sum() > 30
    assert np.abs(np.abs(ratio) - 1.0)[heard].max() < size
    assert np.abs(np.degrees(np.angle(ratio)))[heard].max() < angle


@pytest.mark.parametrize("channel", ["load_factor", "bank_angle"])
def test_paper_law_is_an_integrator(channel):
    """L = K dt / (z - 1) with K = 1: to 0.2 % and 0.1 deg; gain margin 2 / (K dt) = 200 to 1 %,
    phase margin 90 deg less half a sample of lag, delay margin that over 1 rad/s to 2 %. Inserted at
    the bank angle only, to save time.
    """
    scenario = level("paper", "paper", **NO_INTEGRAL)
    response = frequency_response(scenario, channel, AMPLITUDE[channel])
    z = np.exp(1j * response.frequency * DT)
    assert_same(response, DT / (z - 1.0), 0.002, 0.1)
    found = classical_margins(response)
    phase = np.pi / 2.0 - 0.5 * DT
    assert found.gain == pytest.approx(200.0, rel=0.01)
    assert found.phase == pytest.approx(phase, abs=0.002)
    if channel == "load_factor":
        return
    assert gain_margin(scenario, channel, AMPLITUDE[channel]) == pytest.approx(200.0, rel=0.01)
    assert delay_margin(scenario, channel, AMPLITUDE[channel]) == pytest.approx(phase, rel=0.02)


def test_paper_law_without_estimator_at_the_thrust():
    """V' = -a V + T / m, T = m (a - K) V: L = (K - a)(1 - p) / (a (z - p)), p = exp(-a dt)."""
    scenario = level("paper", "paper", **NO_INTEGRAL)
    mass, slope, _, _ = trim_of(scenario)
    a = -slope / mass  # [1/s]
    assert 0.002 < a < 0.1
    response = frequency_response(scenario, "thrust", AMPLITUDE["thrust"])
    z, p = np.exp(1j * response.frequency * DT), np.exp(-a * DT)
    assert_same(response, (1.0 - a) * (1.0 - p) / (a * (z - p)), 0.005, 0.3)


@pytest.mark.parametrize(("channel", "axis"), [("load_factor", 0), ("bank_angle", 1)])
def test_lag_of_the_aircraft_and_lead_of_the_loop(channel, axis):
    """The identified F-16: K / s, its second-order lag, the lead through the trim filter: 0.5 %, 0.5 deg."""
    scenario = level("f16", "identified", **NO_INTEGRAL)
    model = point_mass_of(scenario).record(scenario.aircraft.fuel_fraction)[0]
    w, d = model["response_frequency"][axis], model["response_damping"][axis]
    a = np.array([[0.0, 1.0, 0.0], [-w * w, -2.0 * d * w, 0.0], [1.0, 0.0, 0.0]])
    b, c = np.array([[0.0], [w * w], [0.0]]), np.array([[0.0, 0.0, 1.0]])
    a, b, c, _, _ = cont2discrete((a, b, c, np.zeros((1, 1))), DT)
    response = frequency_response(scenario, channel, AMPLITUDE[channel])
    z = np.exp(1j * response.frequency * DT)
    aircraft = np.array([(c @ np.linalg.solve(x * np.eye(3) - a, b))[0, 0] for x in z])
    zeta = scenario.loop.trim_filter
    share = 1.0 - np.exp(-zeta * DT)
    lead = 1.0 + 2.0 * d / w * zeta * (z - 1.0) / (z - 1.0 + share)
    assert_same(response, lead * aircraft, 0.005, 0.5)


def test_paper_loop_with_its_filter_at_the_thrust():
    """L with the steady Kalman gain of [V, k], commands divided by the estimate: 0.5 % and 1 deg up
    to 20 rad/s, 5 % and 2 deg up to Nyquist, where the theory's filter is not quite the flown one.

    Estimation raises the crossover from 1 to 3.8 rad/s and adds a second integrator: an injected thrust
    looks like a change of effectiveness, which the loop makes good.
    """
    scenario = level("paper", "paper")
    mass, slope, along, thrust = trim_of(scenario)
    a = -slope / mass
    p = np.exp(-a * DT)
    b = along * (1.0 - p) / (a * mass)  # [m/s] of a newton held over a sample
    transition = np.array([[p, b * thrust], [0.0, 1.0]])
    q, r = np.diag([1e-10, 1e-10]), np.array([[1e-10]])
    measures = np.array([[1.0, 0.0]])
    covariance = solve_discrete_are(transition.T, measures.T, q, r)
    gain = covariance @ measures.T / (covariance[0, 0] + r[0, 0])
    response = frequency_response(scenario, "thrust", AMPLITUDE["thrust"])
    theory = []
    for z in np.exp(1j * response.frequency * DT):
        airspeed = b / (z - p)  # of w = 1
        # unknown: estimates of V and k, and v = the loop's command
        m = np.zeros((3, 3), dtype=complex)
        right = np.zeros(3, dtype=complex)
        for row, k in ((0, gain[0, 0]), (1, gain[1, 0])):
            m[row, row] += 1.0
            predicted = np.array([p, b * thrust, b]) / z  # of V, from the sample before
            if row == 0:
                m[row] -= (1.0 - k) * predicted
            else:
                m[row] += k * predicted
                m[row, 1] -= 1.0 / z
            right[row] = k * airspeed
        m[2] = [-mass * a / along, thrust, 1.0]
        right[2] = -mass / along * airspeed
        theory.append(-np.linalg.solve(m, right)[2])
    assert_same(response, np.array(theory), 0.005, 1.0, below=20.0)
    assert_same(response, np.array(theory), 0.05, 2.0)
    found = classical_margins(response)
    assert found.gain_crossover == pytest.approx(3.83, abs=0.1)
