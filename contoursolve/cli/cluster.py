"""The cluster of a Dask scheduler as an executor that says so when the cluster is lost."""

import logging
from collections.abc import Callable, Iterator
from concurrent.futures import CancelledError, Executor, Future, wait
from contextlib import contextmanager
from typing import Any

from contoursolve.cli.options import CouldNotRunError
from contoursolve.cli.printing import say
from contoursolve.extras import need

PATIENCE = 1.0
"""Seconds between two looks at whether the scheduler is still there."""


@contextmanager
def open_cluster(address: str | None) -> Iterator[Executor | None]:
    """The executor of a Dask cluster; None without an address. Raises CouldNotRunError, MissingExtraError."""
    if address is None:
        yield None
        return
    distributed = need("distributed", "dask", "solving on a cluster")
    for name in ("distributed.client", "tornado.application"):
        # They log the traceback of a lost connection, which is told here in one line.
        logging.getLogger(name).setLevel(logging.CRITICAL)
    try:
        client = distributed.Client(address, timeout="10s", set_as_default=False)
    except (OSError, ValueError) as error:
        raise CouldNotRunError(f"no Dask scheduler answers at {address}: {error}") from None
    with client:
        try:
            yield _Cluster(client, address)
        except distributed.scheduler.KilledWorker as error:
            raise CouldNotRunError(f"workers of the Dask cluster at {address} were killed: {error}") from None
        except ImportError as error:
            if not isinstance(error, ModuleNotFoundError) or not (error.name or "").startswith("contoursolve"):
                raise
            told = f"a worker of the Dask cluster at {address} has no {error.name}; install contoursolve for it, too"
            raise CouldNotRunError(told) from None


class _Cluster(Executor):
    """The executor of a client, without which a task would be waited for forever when the scheduler is gone."""

    def __init__(self, client: Any, address: str) -> None:
        self.client, self.address, self.inner = client, address, client.get_executor()
        self.is_told = False
        """Whether it has been told that there are no workers."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> "Future[Any]":
        return _Task(self, self.inner.submit(fn, *args, **kwargs))

    def check(self) -> None:
        """Raise CouldNotRunError if the client has given up its connection; tell that there are no workers."""
        if self.client.status in ("closing", "closed"):
            raise self.lost()
        if not self.is_told and self.client.status == "running" and not self._has_workers():
            told = "has no workers; waiting for one (it needs contoursolve in this version)"
            say(f"the Dask scheduler at {self.address} {told}", err=True)
            self.is_told = True

    def _has_workers(self) -> bool:
        try:
            return bool(self.client.nthreads())
        except OSError:  # the connection was lost just now, which its status tells soon
            return True

    def lost(self) -> CouldNotRunError:
        """The error of a cluster that is gone."""
        return CouldNotRunError(f"the Dask scheduler at {self.address} does not answer any more")


class _Task(Future[Any]):
    """One task of a cluster."""

    def __init__(self, cluster: _Cluster, inner: "Future[Any]") -> None:
        super().__init__()
        self.cluster, self.inner = cluster, inner

    def result(self, timeout: float | None = None) -> Any:
        """What the task gives; `timeout` is not needed here."""
        while not wait([self.inner], PATIENCE).done:
            self.cluster.check()
        try:
            return self.inner.result(timeout)
        except CancelledError:
            raise self.cluster.lost() from None

    def cancel(self) -> bool:
        return self.inner.cancel()
