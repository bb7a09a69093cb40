"""What completes an argument or option: names of what ships, and keys of a scenario."""

import click
from click.shell_completion import CompletionItem


def scenarios(ctx: click.Context, param: click.Parameter, begun: str) -> list[CompletionItem]:
    """Shipped scenarios; a path is completed by the shell."""
    from ftc_jsb.resources import shipped

    return _matching([path.stem for path in shipped("scenarios").glob("*.toml")], begun)


def campaigns(ctx: click.Context, param: click.Parameter, begun: str) -> list[CompletionItem]:
    """Shipped campaigns; a path is completed by the shell."""
    from ftc_jsb.resources import shipped

    folder = shipped("scenarios") / "campaigns"
    return _matching([path.stem for path in folder.glob("*.toml")], begun)


def aircraft(ctx: click.Context, param: click.Parameter, begun: str) -> list[CompletionItem]:
    """Shipped aircraft."""
    from ftc_jsb.resources import aircraft_names

    return _matching(aircraft_names(), begun)


def loops(ctx: click.Context, param: click.Parameter, begun: str) -> list[CompletionItem]:
    """Loops, built in and installed."""
    from ftc_jsb.loops.registry import loop_names

    return _matching(list(loop_names()), begun)


def keys(ctx: click.Context, param: click.Parameter, begun: str) -> list[CompletionItem]:
    """Keys of a scenario, up to the equals sign."""
    from ftc_jsb.scenario.schema import Scenario
    from ftc_jsb.typed_file import key_paths

    return _matching([f"{key}=" for key in key_paths(Scenario)], begun)


def _matching(names: list[str], begun: str) -> list[CompletionItem]:
    found = [CompletionItem(name) for name in sorted(names) if name.startswith(begun)]
    return found or [CompletionItem(begun, type="file")]
