"""One function for many things, several at a time, one on each processor."""

from __future__ import annotations

import gc
import os
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

Item = TypeVar("Item")
Result = TypeVar("Result")


def each(work: Callable[[Item], Result], items: Iterable[Item]) -> list[Result]:
    """Results of a function for items, in their order.

    They are computed by threads: NumPy lets others run while it computes. The first exception that
    an item raises is raised here, after all that have begun have ended.

    Parameters
    ----------
    work
        The function; it writes to nothing that another item's call reads.
    items
        What it is called with. A single one is done by the calling thread.
    """
    waiting = list(items)
    threads = min(os.cpu_count() or 1, len(waiting))
    if threads < 2:
        return [work(item) for item in waiting]
    # Python searches for garbage in the thread that happens to allocate, and would take things
    # apart there that belong to the caller's thread alone, such as windows.
    searches = gc.isenabled()
    gc.disable()
    try:
        with ThreadPoolExecutor(threads) as pool:
            running = [pool.submit(work, item) for item in waiting]
            try:
                return [future.result() for future in running]
            finally:
                for future in running:
                    future.cancel()
    finally:
        if searches:
            gc.enable()
