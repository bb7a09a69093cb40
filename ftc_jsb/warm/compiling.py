"""Compiling before a flight: parts side by side in processes, then the flights that are linked from them."""

import os
import selectors
import subprocess
import sys
import time
from collections.abc import Callable, Sequence

from ftc_jsb.compiled import is_switched_off
from ftc_jsb.errors import UserError
from ftc_jsb.kernel_cache import kernels_of
from ftc_jsb.verified_cache import read_cached, write_cached
from ftc_jsb.warm.needs import EVERYTHING
from ftc_jsb.warm.parts import PARTS

Tell = Callable[[int, int, str], None]
PROCESSES = 2
_KERNELS = ("ftc_jsb.simulation.sample", "ftc_jsb.six_dof.plant")  # all that flights are made of


def is_cold(wanted: Sequence[str] = EVERYTHING) -> bool:
    """Whether kernels of flights have yet to be compiled here, as their source is now.

    Args:
        wanted: what `needs` gave.
    """
    return not is_switched_off() and bool(_cold(wanted))


def warm(tell: Tell, wanted: Sequence[str] = EVERYTHING) -> float:
    """Compile what flights need.

    Args:
        tell: told how many kernels are compiled, of about how many, and what is compiled now.
        wanted: what `needs` gave.

    Returns:
        The time that it took [s].

    Raises:
        UserError: a part could not be compiled.
    """
    started = time.perf_counter()
    cold = _cold(wanted)
    parts = [name for name, part in PARTS.items() if set(part.of) & set(cold)]
    counter = _Counter(tell, sum(PARTS[name].kernels for name in (*parts, *cold)))
    _compile_all(parts, counter)
    _compile_all(cold, counter)
    for need in cold:
        write_cached(_mark(need), b"compiled")
    return time.perf_counter() - started


def _cold(wanted: Sequence[str]) -> list[str]:
    return [need for need in wanted if read_cached(_mark(need)) is None]


def _mark(need: str) -> str:
    """Name, below a cache folder, of a file that is there once the kernels of a need are."""
    return "/".join((*map(kernels_of, _KERNELS), need)).replace("/kernels/", "+") + ".warm"


class _Counter:
    """How many kernels are compiled, whichever process did it."""

    def __init__(self, tell: Tell, total: int) -> None:
        self._tell, self._total, self._done = tell, total, 0

    def add(self, kernels: list[str], meaning: str) -> None:
        """Kernels that a process has begun."""
        if not kernels:  # half a line
            return
        self._done = min(self._done + len(kernels), self._total)
        self._tell(self._done, self._total, f"{meaning}: {kernels[-1]}")


def _compile_all(names: Sequence[str], counter: _Counter) -> None:
    """Parts in processes of their own, so many at once as there are processors; they end with this one."""
    waiting, running = list(names), list[subprocess.Popen[bytes]]()
    with selectors.DefaultSelector() as pipes:
        try:
            while waiting or running:
                while waiting and len(running) < min(PROCESSES, os.cpu_count() or 1):
                    name = waiting.pop(0)
                    running.append(_child(name))
                    pipes.register(running[-1].stdout or -1, selectors.EVENT_READ, name)
                for key, _ in pipes.select():
                    meaning = PARTS[key.data].meaning
                    told = os.read(key.fd, 65536)
                    if told:
                        counter.add(told.decode().split(), meaning)
                        continue
                    pipes.unregister(key.fileobj)  # its end
                    process = next(one for one in running if one.stdout is key.fileobj)
                    running.remove(process)
                    if _ended(process):
                        raise UserError(f"compiling {meaning} failed; the message is above")
        finally:
            for process in running:
                process.kill()
                _ended(process)


def _child(name: str) -> subprocess.Popen[bytes]:
    command = (sys.executable, "-P", "-m", "ftc_jsb.warm.child", name)
    return subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE)


def _ended(process: subprocess.Popen[bytes]) -> int:
    """Exit code of a process that ends."""
    if process.stdout is not None:
        process.stdout.close()
    return process.wait()
