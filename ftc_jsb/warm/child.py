"""A process that compiles one part, and says on its standard output which kernel it is at, a line each."""

import gc
import sys

from ftc_jsb.warm.parts import compile_part


def main() -> None:
    """Compile the part that the command line names."""
    from numba.core import event

    class _Lines(event.Listener):
        """A line for each kernel that is begun."""

        def on_start(self, event: object) -> None:
            name = event.data["dispatcher"].py_func.__name__  # type: ignore[attr-defined]
            print(name, flush=True)

        def on_end(self, event: object) -> None:
            """Nothing to say."""

    gc.disable()  # what the compiler makes is kept to the end, and there is a lot of it
    event.register("numba:compile", _Lines())
    compile_part(sys.argv[1])


if __name__ == "__main__":
    main()
