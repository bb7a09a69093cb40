"""Dask's cluster: a local one by default, or the scheduler at an address; what follows is the same."""

import logging
import os
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from ftc_jsb.errors import LinkError

PATIENCE = 30.0  # [s] for the first worker to come


@contextmanager
def connected(address: str | None, workers: int | None) -> Iterator[Any]:
    """A `distributed.Client`, closed with the cluster if that is its own.

    Args:
        address: of a scheduler; None starts a local cluster.
        workers: of the local cluster; None: one a core.

    Raises:
        LinkError: no scheduler there, or no worker comes.
    """
    import dask
    from distributed import Client, LocalCluster

    from ftc_jsb.campaign.undisturbed import Undisturbed

    settings = {
        "distributed.worker.daemon": True,
        "distributed.comm.timeouts.connect": "5s",
        "distributed.scheduler.allowed-failures": 1,
    }
    with dask.config.set(settings):
        if address is None:
            with (
                LocalCluster(
                    n_workers=workers or os.cpu_count() or 1,
                    threads_per_worker=1,
                    memory_limit=0,  # compiling takes more than flying: it must not end a worker
                    silence_logs=logging.ERROR,
                    dashboard_address=":0",
                ) as cluster,
                Client(cluster) as client,
            ):
                client.register_plugin(Undisturbed())
                yield client
            return
        try:
            client = Client(address, timeout=5)
        except (OSError, ValueError, TimeoutError) as error:
            raise LinkError(
                f"--scheduler {address}: no Dask scheduler answers there: {error}"
            ) from None
        with client:
            try:
                client.wait_for_workers(1, timeout=PATIENCE)
            except TimeoutError:
                raise LinkError(
                    f"--scheduler {address}: has no worker after {PATIENCE:g} s"
                ) from None
            yield client
