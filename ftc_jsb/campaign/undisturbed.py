"""Local workers leave Ctrl-C to the client: it ends them when it has saved what is flown."""

import signal
import threading
from typing import Any

from distributed import WorkerPlugin


class Undisturbed(WorkerPlugin):
    """SIGINT is ignored in a worker's process."""

    def setup(self, worker: Any) -> None:
        """Called in each worker when it starts, also in one that takes the place of a dead one."""
        if threading.current_thread() is threading.main_thread():
            signal.signal(signal.SIGINT, signal.SIG_IGN)
