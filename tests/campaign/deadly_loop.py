"""A loop that ends the process it flies in, for one of its settings."""

import os
import signal

from ftc_jsb.control.protocol import LoopSetup
from tests.control.my_loop import MyLoop

DEADLY = 13.0  # 1/s


class DeadlyLoop(MyLoop):
    """Flies as MyLoop, but not with that filter."""

    def __init__(self, setup: LoopSetup) -> None:
        super().__init__(setup)
        if setup.settings.trim_filter == DEADLY:
            os.kill(os.getpid(), signal.SIGKILL)
