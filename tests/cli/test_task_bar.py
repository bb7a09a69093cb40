"""How far a long task is: a bar on a terminal with the time left, lines elsewhere, nothing with --quiet."""

import pytest

from ftc_jsb.cli import task_bar as module
from ftc_jsb.cli.printing import hushed
from ftc_jsb.cli.task_bar import step_bar, task_bar


@pytest.fixture
def terminal(capfd, monkeypatch):
    monkeypatch.setattr(module, "_on_terminal", lambda: True)
    monkeypatch.setenv("FORCE_COLOR", "1")
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", "120")


def test_terminal_sees_what_is_done_and_the_time_left(terminal, capfd):
    with task_bar("Compiling") as show:
        show(3, 4, "outer loop: observe")
    shown = capfd.readouterr().err
    assert all(part in shown for part in ("Compiling", "3/4", "left", "outer loop: observe"))


def test_steps_count_what_is_over_not_what_is_begun(terminal, capfd):
    with step_bar("Margins", 9) as tell:
        tell("thrust: gain")
    assert "0/9" in capfd.readouterr().err


def test_file_gets_lines(capfd):
    with step_bar("Margins", 9) as tell:
        tell("thrust: gain")
    assert capfd.readouterr().err == "thrust: gain\n"
    with step_bar("Report", 9, lines=False) as tell:
        tell("page")
    assert capfd.readouterr().err == ""


def test_quiet_gets_nothing(terminal, capfd):
    with hushed(), step_bar("Margins", 9) as tell, task_bar("Compiling") as show:
        tell("thrust: gain")
        show(1, 2, "observe")
    assert capfd.readouterr().err == ""
