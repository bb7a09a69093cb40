"""Settings and state of the outer loop, as the records that its kernels read and write."""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ftc_jsb.estimation.detector import DETECTOR
from ftc_jsb.estimation.process import FILTER, OUTPUTS, STATES
from ftc_jsb.isolation.records import ISOLATION, ISOLATION_SETTINGS

NO_ESTIMATOR, UNSCENTED, EXTENDED = 0, 1, 2
ESTIMATED, ASSUMED_HEALTHY, TRUE = 0, 1, 2

LOOP_SETTINGS = np.dtype(
    [
        ("dt", float),  # [s]
        ("estimator", np.int64),  # NO_ESTIMATOR, UNSCENTED or EXTENDED
        ("effectiveness", np.int64),  # the law's: ESTIMATED, ASSUMED_HEALTHY or TRUE
        ("gains", float, (3,)),  # K_c [1/s]
        ("integral_gains", float, (3,)),  # [1/s^2]
        ("track_path", np.int64),  # 1: y is the position, of index 2
        ("path_gains", float, (2,)),  # of position [1/s^2] and velocity errors [1/s]
        ("bank_share", float),  # until bank has come: 0 path and turn alike, 1 path alone
        ("drag_correction", np.int64),  # 1: the law pays for drag that is measured beyond the polar
        ("upright", np.int64),  # 1: bank below 90 deg, load factor for the bank that is there
        ("speed_first", np.int64),  # 1: climb and turn are given up before airspeed
        ("airspeed_reserve", float),  # [m/s] that is spent before they are
        ("trim_share", float),  # of the way to u that (10) goes in a sample
        ("effectiveness_floor", float),  # sigma: the least effectiveness the law divides by
        (
            "effectiveness_most",
            float,
        ),  # and the largest: an instrument may tell of more than there is
        ("lead", float, (2,)),  # [s] of load factor and bank, against the inner loop's lag
        ("lead_filter", float),  # [1/s] of the rate that it takes
        ("lead_share", float),  # of the way that this filter goes in a sample
        ("process_noise", float, (STATES,)),
        ("measurement_noise", float, (OUTPUTS,)),
        ("initial_covariance", float, (STATES,)),
        ("acceleration_noise", float),  # R of the force along the velocity [m^2/s^4]; 0 = not used
        ("angle_noise", float, (4,)),  # variance of alpha, sideslip, elevator, flap [rad^2]
        ("angle_bias", float, (4,)),  # standard deviation of what they are off by [rad]
        ("acceleration_bias", float),  # likewise [m/s^2]
        ("airspeed_bias", float),  # [m/s]
        ("response_time", float),  # [s], sets Q of the effectiveness; 0 = process_noise has it
        ("feedback", np.int64),  # 1: errors of the estimate, 0: of the measurement
        ("spread", float),  # n_a + kappa of (26)
        ("gate", float),  # bound on the normalised innovation squared; 0 = off
        ("gate_patience", np.int64),
        ("bounded", np.int64),  # 1: estimates kept in [sigma, 1]
        ("detector_margin", float),
        ("detector_sigmas", float),
        ("detector_hold", float),  # [s]
        ("isolation", ISOLATION_SETTINGS),
    ]
)

KNOWN = np.dtype(  # of the aircraft's state; where a sensor is silent, what is known instead
    [
        ("measurement", float, (OUTPUTS,)),  # airspeed, flight path angle, heading; nan = silent
        ("state", float, (OUTPUTS,)),
        ("altitude", float),  # [m]
        ("position", float, (2,)),  # north, east [m]
    ]
)
OBSERVER = np.dtype(  # what was flown and estimated
    [
        ("rotor_speed", float),  # of the healthy engine that the loop imagines
        ("thrust", float),  # that engine's thrust [N]
        ("other_rotor", float),  # the same if idle thrust and spool rate are a little wrong
        ("thrust_doubt", float),  # how far the two differ [N]
        ("trim_thrust", float),  # [N], at the start
        ("fuel_flow", float),  # that it is believed to burn [kg/s]
        ("drag_coefficient", float),  # measured, of the previous sample
        ("alpha", float),  # [rad], likewise
        ("load_factor", float),
        ("bank_angle", float),  # [rad]
        ("acceleration_noise", float),  # R of this sample [m^2/s^4]
        ("noise_seen", float),  # the same, larger where its innovations are
        ("power", float),  # of that force's normalised innovations, lagged: 1 where R is right
        ("product", float),  # of neighbouring ones: 0 where they are white
        ("last", float),  # of them
        ("blind", np.int64),  # 1 while what it cannot know is more than what it would learn
        ("considered", float),  # standard deviation of the effectiveness by the instruments' biases
        ("acceleration_innovation", float),  # [m/s^2]
        ("acceleration_innovation_std", float),
        ("process_noise", float, (STATES,)),
        ("filter", FILTER),
        ("detector", DETECTOR),
    ]
)
INNER_LOOP = np.dtype(  # load factor and bank: what is sent to the inner loop, and its lag
    [
        ("slow", float, (2,)),  # demands behind the lead's filter
        ("command", float, (2,)),  # sent to the plant, lead included
        ("response", float, (2, 2)),  # of a healthy inner loop to them: value and rate
    ]
)
LOOP_STATE = np.dtype(
    [
        ("known", KNOWN),
        ("observer", OBSERVER),
        ("isolation", ISOLATION),
        ("trim", float, (3,)),  # u_n of (10): thrust [N], load factor, bank [rad]
        ("demand", float, (3,)),  # limited u of the previous sample
        ("integral", float, (3,)),  # of the tracking errors
        ("drag_beyond", float),  # measured drag coefficient less the polar's
        ("sustained", float),  # deceleration [m/s^2] by it that lasts: what thrust has to pay for
        # for want of thrust: path angle [rad], part of the turn, airspeed [m/s]
        ("given_up", float, (3,)),
        ("lasting", float),  # effectiveness of thrust, lagged
        ("short_time", float),  # [s] for which references could not be flown
        ("inner_loop", INNER_LOOP),
    ]
)


class LoopArrays(NamedTuple):
    """What a built-in loop is made of, as its kernels take it."""

    settings: npt.NDArray[Any]  # (1,) LOOP_SETTINGS
    model: npt.NDArray[Any]  # (1,) MODEL that the loop counts on
    state: npt.NDArray[Any]  # (1,) LOOP_STATE
    isolates: bool | None = (
        None  # None: faults are not isolated, and the kernels of that not compiled
    )
