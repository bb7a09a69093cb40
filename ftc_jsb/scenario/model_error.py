"""[model_error] of a scenario: by how much the model that the outer loop counts on is wrong."""

from typing import Annotated

from pydantic import Field

from ftc_jsb.typed_file import Section

_Factor = Annotated[float, Field(ge=0.5, le=2.0)]


class ModelError(Section):
    """[model_error]: factors of the loop's own point mass over the aircraft that it was made from."""

    mass: _Factor = 1.0
    drag: _Factor = 1.0  # of every drag coefficient
    thrust: _Factor = 1.0  # of the thrust deck
