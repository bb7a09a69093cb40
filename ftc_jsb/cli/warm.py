"""`ftc-jsb warm`: kernels compiled before the first flight."""

import click

from ftc_jsb.cli.options import examples, quiet_option
from ftc_jsb.cli.printing import progress_line


@examples("ftc-jsb warm")
@click.command()
@quiet_option
def warm() -> None:
    """Compile the numerical kernels now, so that the first flight need not."""
    from ftc_jsb.warm import is_cold
    from ftc_jsb.warm import warm as compile_all

    if not is_cold():
        click.echo("The kernels are compiled.")
        return
    click.echo(f"The kernels are compiled, in {compile_all(progress_line):.0f} s.")
