"""Settings and state of the isolation, as the records that its kernels read and write."""

import numpy as np

from ftc_jsb.vocabulary.channels import SURFACES
from ftc_jsb.vocabulary.hypotheses import HYPOTHESES
from ftc_jsb.vocabulary.signals import SENSED

# Residuals: zero on the average where nothing is wrong. Vectors are in body axes.
INERTIAL_X = 0  # [m/s^2], 3: accelerometers and attitude, less what the positions say
AIR_X = 3  # [m/s], 3: velocity through the air, less that over the ground and the lasting wind
GYRO_X = 6  # [rad/s], 3: gyros, less the turning of the attitude
LIFT = 9  # [rad]: angle of attack, less the one that lifts so much
SIDE = 10  # load factor to the side, less that of the sideslip
FORCE = 11  # [m/s^2]: force along the velocity over mass, less thrust and drag
RESIDUALS = 12

COUNT = len(SENSED)
SURFACE_COUNT = len(SURFACES)
BLOCK = 0.1  # [s] over which residuals are averaged before they are looked at
SPANS = (2, 5, 10, 20, 50, 100)  # blocks, over which a fault may have lasted
LONGEST = SPANS[-1]
DRIFTS = 3  # roll, pitch, yaw that go away slowly have signatures of their own
ROWS = COUNT + DRIFTS + 1  # signatures: instruments in the order of SIGNALS, drifts, thrust
DRIFT_ROW, THRUST_ROW = COUNT, COUNT + DRIFTS

# Why an instrument is excluded
ACCEPTED, DISAGREES, STALE, SILENT, NOISY, JUMPED = range(6)

ISOLATION_SETTINGS = np.dtype(
    [
        ("enabled", np.int64),
        ("threshold", float),  # log likelihood ratio that is no chance
        ("calm", float, (len(SPANS), RESIDUALS)),  # variance of each span's means in still air
        ("gust", float, (len(SPANS), RESIDUALS)),  # what moderate turbulence adds
        ("start", float, (RESIDUALS,)),  # variance of what models are off by in a flight
        ("bias", float, (COUNT,)),  # standard deviation of what instruments are off by in a flight
        ("noise", float, (COUNT,)),  # standard deviation of readings; 0 = perfect
        ("ordinary", float, (COUNT,)),  # the same, or that of a tactical one if that is more
        ("sizes", float, (ROWS,)),  # of faults that have to be reckoned with, standard deviation
        ("stale", float, (COUNT,)),  # [s] for which a reading that lives cannot stay the same
        ("tolerance", float, (COUNT,)),  # within which an excluded one agrees again
        ("position_lag", float, (3,)),  # [s] of north, east, altitude
        ("pick_off_lag", float, (SURFACE_COUNT,)),  # samples by which pick-offs are late
        ("gyro_lead", float),  # samples by which gyros are ahead of the attitude
    ]
)
NAVIGATION = np.dtype(
    [
        ("position", float, (3,)),  # north, east, down [m]
        ("velocity", float, (3,)),  # [m/s]
        ("acceleration", float, (3,)),  # to be added to the accelerometers', body axes [m/s^2]
        ("reading", float, (3,)),  # last position that was new
        ("age", float, (3,)),  # [s] of it
        ("wind", float, (3,)),  # that lasts [m/s]
        ("time", float),  # [s] since the start
        ("rates", float, (3,)),  # last of the gyros [rad/s]
        ("moving", float, (3,)),  # rates of roll, pitch, yaw by the gyros [rad/s]
        ("attitude", float, (3,)),  # by the gyros, drawn to the measured one in half a second [rad]
        ("steady", float, (3,)),  # likewise in 20 s
    ]
)
WINDOWS = np.dtype(
    [
        ("total", float, (RESIDUALS,)),  # of the block that is being filled
        ("filled", np.int64),  # samples of it
        ("blocks", float, (LONGEST, RESIDUALS)),  # a ring of their means
        ("winds", float, (LONGEST, 3)),  # lasting wind at the time [m/s]
        ("thrusts", float, (LONGEST,)),  # of the model over mass at the time [m/s^2]
        ("doubts", float, (LONGEST,)),  # what they may be off by while the engine spools [m/s^2]
        ("mean_thrust", float, (len(SPANS),)),  # of each span
        ("mean_doubt", float, (len(SPANS),)),  # likewise
        ("estimates", float, (LONGEST,)),  # effectiveness of thrust at the time
        ("next", np.int64),  # place in the ring
        ("count", np.int64),  # blocks in it since it was emptied, or more
        ("baseline", float, (RESIDUALS,)),  # of the time before the ring
        ("biased", float, (RESIDUALS,)),  # variance by the instruments' biases
        ("learned", np.int64),  # blocks in the baseline
        ("gust", float),  # power of the turbulence over that of moderate
        ("pull", float),  # largest load factor of late, beside 1
        ("side_slope", float),  # load factor to the side, per rad of sideslip; 0 = not known
        ("slip_drag", float),  # deceleration by drag, per rad of sideslip [m/s^2]
        ("thrust", float),  # of the model over mass, lagged [m/s^2]
        ("transient", float),  # of it [m/s^2]
        ("means", float, (len(SPANS), RESIDUALS)),  # of each span, less the baseline
    ]
)
SURFACE = np.dtype(
    [
        ("commanded", float),  # position of the last sample
        ("due", float),  # the same as late as the pick-off
        ("reading", float),
        ("square", float),  # sums of changes of the command over their noise
        ("product", float),  # and of those times changes of the reading
        ("square_soon", float),  # both over a shorter time
        ("product_soon", float),
        ("gain", float),  # from the one to the other: effectiveness
        ("gain_std", float),
        ("rough", float),  # power of what the changes differ by, over that of the noise
        ("offset", float),  # reading less command, lagged
        ("lasting", float),  # of it
        ("away", float),  # [s] for which the offset has been there
        ("obeys", float),  # [s] for which a faulty surface has obeyed again
        ("faulty", np.int64),
        ("told", np.int64),  # 1 where that has been said
        ("statistic", float),  # log likelihood ratio
    ]
)
ISOLATION = np.dtype(
    [
        ("flies", np.int64),  # 1 where there are instruments to compare
        ("navigation", NAVIGATION),
        ("windows", WINDOWS),
        ("surfaces", SURFACE, (SURFACE_COUNT,)),
        ("commanded", float, (SURFACE_COUNT,)),  # positions; nan = not known
        ("raw", float, (COUNT,)),  # readings of this sample; nan = silent
        ("signals", float, (COUNT,)),  # accepted readings of this sample
        ("readings", float, (COUNT,)),  # last finite ones of the instruments themselves
        ("change", float, (COUNT,)),  # of the last new one
        ("rough", float, (COUNT,)),  # power of changes of that change, over that of the noise
        ("same", float, (COUNT,)),  # [s] for which a reading has not changed
        ("silent", float, (COUNT,)),  # [s] for which there has been none
        ("excluded", np.int64, (COUNT,)),  # ACCEPTED, or why not
        ("away", float, (COUNT,)),  # error that is found of an excluded gyro or accelerometer
        ("apart", float, (COUNT,)),  # of an excluded one: reading less accepted, lagged
        ("out", float, (COUNT,)),  # [s] since it is excluded, of a gyro
        ("agrees", float, (COUNT,)),  # [s] for which an excluded one has agreed again
        ("euler", float, (3,)),  # roll, pitch, yaw of the last sample [rad]
        ("turning", float, (3,)),  # body rates by their changes, lagged [rad/s]
        ("sideslip", float),  # that makes drag, lagged [rad]
        ("residual", float, (RESIDUALS,)),  # of this sample
        ("moved", float, (COUNT,)),  # scratch of `redundancy`
        ("agreement", float, (RESIDUALS,)),  # scratch of `redundancy`
        ("frame", float, (3,)),  # likewise
        ("signature", float, (ROWS, RESIDUALS)),
        ("likelihood", float, (ROWS,)),  # log ratios against healthy, over the span that tells most
        ("amplitude", float, (ROWS,)),  # size that each fault would have
        ("unexplained", float),  # log likelihood that no single fault explains
        ("statistic", float),  # the greatest ratio, over the threshold
        ("probabilities", float, (len(HYPOTHESES),)),
        ("suspect", np.int64),  # place in HYPOTHESES
        ("probability", float),
        (
            "before",
            float,
        ),  # effectiveness of thrust that an instrument has spoilt since; nan = it has not
        ("wait", float),  # [s] until the residuals mean something again
        ("ambiguous", float),  # [s] for which nobody has stood out
        ("thrust", np.int64),  # 1 from a loss of thrust on, until it is back
        ("effectiveness", float),  # of the thrust that `agreement` counts on
        ("since", float),  # [s] since the loss was declared
        ("quiet", float),  # [s] left in which the effectiveness recovers from an instrument's fault
    ]
)
