"""`ftc-jsb`: its commands, and how each of them ends if it fails."""

import sys
from typing import Any

import click

import ftc_jsb
from ftc_jsb.cli.bench import bench
from ftc_jsb.cli.campaign import campaign
from ftc_jsb.cli.check import check
from ftc_jsb.cli.compare import compare
from ftc_jsb.cli.completion import completion
from ftc_jsb.cli.convert import convert
from ftc_jsb.cli.crash_file import reported
from ftc_jsb.cli.exit_codes import BAD_USAGE, INTERRUPTED, UNEXPECTED
from ftc_jsb.cli.export import export
from ftc_jsb.cli.figures import figures
from ftc_jsb.cli.fly import fly
from ftc_jsb.cli.identify import identify
from ftc_jsb.cli.inner_loop import inner_loop
from ftc_jsb.cli.inventory import list_
from ftc_jsb.cli.margins import margins
from ftc_jsb.cli.options import examples
from ftc_jsb.cli.plugin import plugin
from ftc_jsb.cli.printing import message
from ftc_jsb.cli.replay import replay
from ftc_jsb.cli.report import report
from ftc_jsb.cli.schema import schema
from ftc_jsb.cli.surroundings import check_arguments, check_memory
from ftc_jsb.cli.theory import theory
from ftc_jsb.cli.warm import warm
from ftc_jsb.errors import UserError
from ftc_jsb.interruption import ended_by_signals
from ftc_jsb.suggestion import did_you_mean


class _Commands(click.Group):
    """Turns every `UserError` into one sentence and exit code 2, what nobody expected into exit code 3."""

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Say what a misspelt command may have meant."""
        if args and args[0] not in self.commands and not args[0].startswith("-"):
            hint = did_you_mean(args[0], self.commands)
            ctx.fail(f"No such command {args[0]!r}{hint or '.'}")
        return super().resolve_command(ctx, args)

    def invoke(self, ctx: click.Context) -> Any:
        try:
            check_arguments(sys.argv[1:])
            check_memory(next((text for text in sys.argv[1:] if not text.startswith("-")), ""))
            with ended_by_signals():
                return super().invoke(ctx)
        except UserError as error:
            message(str(error))
            sys.exit(BAD_USAGE)
        except KeyboardInterrupt:
            message("interrupted")
            sys.exit(INTERRUPTED)
        except MemoryError:
            message("there is not enough memory for this")
            sys.exit(BAD_USAGE)
        except (click.ClickException, click.Abort, click.exceptions.Exit, BrokenPipeError):
            raise
        except Exception as error:
            if isinstance(error, OSError) and error.filename is not None:
                message(f"{str(error.filename)[:200]}: {error.strerror}")
                sys.exit(BAD_USAGE)
            message(reported(error))
            sys.exit(UNEXPECTED)


@examples(
    "ftc-jsb compare paper            the paper, on three models, with FTC and without",
    "ftc-jsb fly severe --model jsbsim",
    "ftc-jsb completion bash          completes names and keys in your shell",
)
@click.group(cls=_Commands, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(ftc_jsb.__version__, prog_name="ftc-jsb")
def main() -> None:
    """Fault-tolerant flight control on a point mass and on JSBSim fighters.

    SCENARIO is the path of a .toml file or the name of a shipped one: see `ftc-jsb list`.
    """


for _command in (
    bench, campaign, check, compare, completion, convert, export, figures, fly,
    identify, inner_loop, list_, margins, plugin, replay, report, schema, theory, warm,
):  # fmt: skip
    main.add_command(_command)
