"""Completion, examples and suggestions of the command line itself."""

import pytest
from click.shell_completion import ShellComplete

from ftc_jsb.cli.main import main
from tests.cli.command import assert_refused, run


def _completed(words, begun):
    found = ShellComplete(main, {}, "ftc-jsb", "_FTC_JSB_COMPLETE").get_completions(words, begun)
    return [item.value for item in found if item.type == "plain"]


@pytest.mark.parametrize(
    ("words", "begun", "expected"),
    [
        (["fly"], "sev", ["severe"]),
        (["fly", "paper", "--set"], "fault[0].sta", ["fault[0].start="]),
        (["fly", "paper", "--loop"], "rob", ["robust"]),
        (["identify"], "f1", ["f15", "f16"]),
        (["campaign", "fly"], "smo", ["smoke"]),
        ([], "comp", ["compare", "completion"]),
    ],
)
def test_names_and_keys_are_completed(words, begun, expected):
    assert _completed(words, begun) == expected


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_the_script_of_a_shell_asks_the_program(shell, tmp_path):
    assert "_FTC_JSB_COMPLETE" in run("completion", shell, cwd=tmp_path).stdout


@pytest.mark.parametrize("name", sorted(main.commands))
def test_every_command_has_an_example_that_is_its_own(name):
    epilog = main.commands[name].epilog or ""
    assert f"ftc-jsb {name}" in epilog


def test_a_misspelt_command_is_guessed(tmp_path):
    assert_refused(
        run("fli", "paper", cwd=tmp_path), "No such command 'fli'", "did you mean 'fly'?"
    )
