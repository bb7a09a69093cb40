"""`ftc-jsb warm`: kernels compiled before the first flight."""

import click

from ftc_jsb.cli.options import examples, quiet_option


@examples("ftc-jsb warm")
@click.command()
@quiet_option
def warm() -> None:
    """Compile the numerical kernels now, so that the first flight need not."""
    from ftc_jsb.cli.task_bar import task_bar
    from ftc_jsb.warm import is_cold
    from ftc_jsb.warm import warm as compile_all

    if not is_cold():
        click.echo("The kernels are compiled.")
        return
    with task_bar("Compiling") as show:
        taken = compile_all(show)
    click.echo(f"The kernels are compiled, in {taken:.0f} s.")
