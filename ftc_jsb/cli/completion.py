"""`ftc-jsb completion`: the script that switches completion on in a shell."""

import click
from click.shell_completion import get_completion_class

from ftc_jsb.cli.options import examples

SHELLS = ("bash", "zsh", "fish")
PROGRAM, VARIABLE = "ftc-jsb", "_FTC_JSB_COMPLETE"


@examples(
    "ftc-jsb completion bash >> ~/.bashrc",
    "ftc-jsb completion zsh >> ~/.zshrc",
    "ftc-jsb completion fish > ~/.config/fish/completions/ftc-jsb.fish",
)
@click.command()
@click.argument("shell", type=click.Choice(SHELLS))
def completion(shell: str) -> None:
    """Print the script that completes commands, scenarios, aircraft, loops and keys in SHELL."""
    from ftc_jsb.cli.main import main

    kind = get_completion_class(shell)
    assert kind is not None  # SHELLS are click's own
    click.echo(kind(main, {}, PROGRAM, VARIABLE).source())
