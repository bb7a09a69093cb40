"""Texts, numbers and paths that nobody means: one sentence each, at once and in little memory, exit code 2."""

import os
import resource
import subprocess
import sys
import time

import pytest

from ftc_jsb.errors import UserError
from ftc_jsb.scenario.load import load_scenario
from ftc_jsb.toml_file import TomlError, parse_toml

HEAD = """name = "x"
reference = {airspeed = [[0, 300]], flight_path_deg = [[0, 0]], heading_deg = [[0, 0]]}
"""
LONG = "x" * 5000


def run(*arguments, memory=None, **options):
    """The command in a process of its own: its exit code, and what it said."""

    def limited():
        if memory:
            resource.setrlimit(resource.RLIMIT_AS, (memory, memory))

    command = [sys.executable, "-m", "ftc_jsb", *arguments]
    made = subprocess.run(
        command, capture_output=True, timeout=60, preexec_fn=limited, check=False, **options
    )
    return made.returncode, made.stderr.decode("utf-8", "replace")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (f"seed = {'9' * 5000}", "thousands of digits"),
        (f"seed = 0x{'f' * 5000}", "more than 64 bits"),
        (f"seed = {'9' * 4000}", "more than 64 bits"),
        ("a = " + "[" * 10_000, "32 deep"),
        ("a = " + "[" * 100 + "]" * 100, "32 deep"),
        ("a" + ".a" * 20_000 + " = 1", "32 parts"),
        ("[a" + ".a" * 20_000 + "]", "32 parts"),
        ("[[a" + ' . "a"' * 20_000 + "]]", "32 parts"),
        ("x = {b = 1, a" + ".a" * 20_000 + " = 1}", "32 parts"),
        ("a = " + "{a = " * 400 + "1" + "}" * 400, "32 deep"),
        ("loop.rate = 1e-323", "loop.rate: .*greater than or equal to 1"),
        ("duration = 1e-323", "duration x loop.rate"),
        ('[[fault]]\neffectiveness = 0.5\nstart = 1\nshape = "ramp"\nrise = 1e-323', "rise: "),
        ("seed = nan", "seed"),
    ],
)
def test_hostile_toml_is_refused_in_a_sentence_within_a_second(tmp_path, text, said):
    path = tmp_path / "hostile.toml"
    path.write_text(f"{HEAD}{text}\n")
    began = time.process_time()
    with pytest.raises(UserError, match=said) as refused:
        load_scenario(str(path))
    assert time.process_time() - began < 1.0  # [s]
    assert str(refused.value).startswith(str(path))
    assert len(str(refused.value)) < len(str(path)) + 300


def test_sentences_and_long_lists_are_no_dotted_keys():
    """What looks like a key of many parts inside of values is read as what it is."""
    numbers = ", ".join(f"[{k}.5, 300.25]" for k in range(5000))
    text = f'a = [{numbers}]\nb = "{"One. Two. " * 30}"\nc = """\n{"Go. " * 20}\n"""\n'
    assert len(parse_toml(text)["a"]) == 5000
    with pytest.raises(TomlError, match=r"^not TOML: "):
        parse_toml("a = = 1")


@pytest.mark.parametrize(
    "arguments",
    [
        ("fly", LONG),
        ("fly", f"{LONG}.toml"),
        ("fly", "paper", "--set", f"aircraft.name='./{'y' * 290}'", "--model", "jsbsim"),
        ("fly", "paper", "--out", LONG),
        ("fly", "paper", "--set", "fault[²].start=1"),
        ("fly", "paper", "--realtime", "nan"),
        ("fly", "paper", "--linger", "nan"),
        ("fly", "paper", "--mavlink", "udpout::14550", "--mavlink-key", "/dev/zero"),
        ("fly", "paper", "--set", "wind.speed=1e-323", "--set", f"a{'.a' * 20_000}=1"),
        ("margins", "paper", "--amplitude", "nan"),
        ("margins", "paper", "--altitude", "nan"),
        ("campaign", f"{LONG}.toml"),
        ("report", LONG),
        ("report", "/dev/zero"),
        ("report", "none.nc", "--margins", "/dev/zero"),
        ("convert", "none.nc", "--to", "csv", "--out", LONG),
        ("fly", os.fsdecode(b"caf\xe9.toml")),
        ("fly", "paper", "--out", os.fsdecode(b"caf\xe9")),
    ],
)
def test_hostile_argument_is_refused_in_a_sentence(tmp_path, arguments):
    code, said = run(*arguments, cwd=tmp_path, memory=4_000_000_000)
    assert code == 2, said
    assert "Traceback" not in said
    assert "internal error" not in said
    assert len(said) < 6000
    assert list(tmp_path.iterdir()) == []


def test_limited_memory_is_told_at_once():
    """Under 400 MB the libraries of linear algebra wait for ever."""
    code, said = run("fly", "paper", memory=400_000_000)
    assert code == 2
    assert said == (
        "ftc-jsb: there is not enough memory for this: address space is limited to 0.4 GB (ulimit -v); "
        "expected 1.5 GB or more\n"
    )
    assert run("check", "paper", memory=800_000_000)[0] == 0
