"""Work for any executor, a few pieces under way at once, with the results in order."""

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Executor, Future, ThreadPoolExecutor
from contextlib import contextmanager
from typing import TypeVar

Result = TypeVar("Result")

THREADS = "contoursolve"
"""What the names of the threads begin with."""


@contextmanager
def threads(count: int) -> Iterator[Executor | None]:
    """Threads as an executor; none for one. Whoever presses Ctrl-C does not wait for what they have under way, which
    may be minutes."""
    if count <= 1:
        yield None
        return
    executor = ThreadPoolExecutor(count, THREADS)
    is_waiting = True
    try:
        yield executor
    except KeyboardInterrupt:
        is_waiting = False
        raise
    finally:
        executor.shutdown(wait=is_waiting, cancel_futures=not is_waiting)


def in_order(tasks: Iterable[Callable[[], Result]], executor: Executor | None, ahead: int) -> Iterator[Result]:
    """The results of tasks in their order, of which at most one more than `ahead` are under way or waiting to be taken;
    without an executor, one after the other. An error of a task ends all of them, and is raised with its traceback."""
    if executor is None:
        yield from (task() for task in tasks)
        return
    waiting: deque[Future[Result]] = deque()
    try:
        for task in tasks:
            waiting.append(executor.submit(task))
            if len(waiting) > ahead:
                yield waiting.popleft().result()
        while waiting:
            yield waiting.popleft().result()
    finally:
        for future in waiting:
            future.cancel()
