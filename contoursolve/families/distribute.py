"""Work for any executor, a few pieces under way at once, with the results in order."""

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Executor, Future
from typing import TypeVar

Result = TypeVar("Result")


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
