"""Bounded numbers and texts that several sections of a scenario share."""

from typing import Annotated

from pydantic import Field

Text = Annotated[str, Field(min_length=1, max_length=300)]


Time = Annotated[float, Field(ge=0.0, le=86400.0)]  # s


Point = tuple[Time, Annotated[float, Field(ge=-1e6, le=1e6)]]


Error = Annotated[float, Field(ge=0.0, le=1e4)]


Bound = Annotated[float, Field(ge=-1e6, le=1e6)]
