"""Did FTC help: by the verdicts where they differ, else by the RMSE of the airspeed."""

import pytest

from ftc_jsb.analysis.ftc_effect import answer


def metrics(verdict, rmse):
    return {"verdict": verdict, "rmse_airspeed_mps": rmse}


@pytest.mark.parametrize(
    ("with_ftc", "without", "said"),
    [
        (("inside limits", 0.05), ("inside limits", 2.3), "helped"),
        (("inside limits", 45.1), ("inside limits", 45.1), "no difference"),
        (("inside limits", 2.3), ("inside limits", 0.5), "hurt"),
        (
            ("inside limits", 0.05),
            ("inside limits", 0.09),
            "no difference",
        ),  # nobody could measure it
        (("departed", 0.5), ("limits broken", 5.0), "hurt"),
        (("inside limits", 2.0), ("loss of control", 1.0), "helped"),
        (("limits broken", None), ("limits broken", None), "no difference"),
    ],
)
def test_answer(with_ftc, without, said):
    assert answer(metrics(*with_ftc), metrics(*without)) == said
