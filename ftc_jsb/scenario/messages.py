"""One clear sentence out of a pydantic error."""

from pydantic import ValidationError


def key_path(location: tuple[int | str, ...]) -> str:
    """`("fault", 0, "start")` as `fault[0].start`."""
    path = ""
    for part in location:
        path += f"[{part}]" if isinstance(part, int) else f".{part}" if path else part
    return path


def first_problem(error: ValidationError) -> str:
    """The first problem of a validation: key, value, what was expected; and how many more."""
    problems = error.errors(include_url=False)
    problem = problems[0]
    location = problem["loc"]
    key = key_path(location)
    if problem["type"] == "extra_forbidden":
        text = f"unknown key {key!r}; see docs/scenarios.md for the keys there are"
    elif problem["type"] == "missing":
        text = f"{key}: missing, and it has no default"
    else:
        message = problem["msg"].removeprefix("Value error, ").removeprefix("Assertion failed, ")
        message = message[0].lower() + message[1:]
        value = problem["input"]
        shown = repr(value) if not isinstance(value, dict | list) or len(str(value)) < 80 else "..."
        text = f"{key}: {message} (got {shown})" if key else message
    more = len(problems) - 1
    return f"{text} (and {more} more problem{'s' if more > 1 else ''})" if more else text
