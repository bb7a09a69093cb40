"""[wind] of a scenario: steady wind, shear, gusts, turbulence."""

from typing import Annotated, Literal

from pydantic import Field

from ftc_jsb.scenario.types import Time
from ftc_jsb.typed_file import Section


class Gust(Section):
    """[[wind.gust]]: a discrete gust, 1 - cosine up over `length`, held, and down again."""

    speed: float = Field(0.0, ge=0.0, le=100.0)  # m/s, level part
    from_deg: float = Field(270.0, ge=0.0, le=360.0)
    updraught: float = Field(0.0, ge=-100.0, le=100.0)  # m/s
    start: Time  # s
    length: float = Field(ge=1e-3, le=600.0)  # s
    hold: float = Field(0.0, ge=0.0, le=3600.0)  # s


class Wind(Section):
    """[wind]: steady wind at the initial altitude, shear, gusts, turbulence."""

    speed: float = Field(0.0, ge=0.0, le=100.0)  # m/s
    from_deg: float = Field(270.0, ge=0.0, le=360.0)
    shear: float = Field(0.0, ge=-0.1, le=0.1)  # 1/s: m/s more for each metre up
    turbulence: Literal["none", "light", "moderate", "severe"] = "none"  # MIL-F-8785C
    gust: Annotated[tuple[Gust, ...], Field(max_length=8)] = ()
