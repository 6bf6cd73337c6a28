"""One function for many things at a time."""

import gc
import threading
import time

import pytest

from core import parallel
from core.parallel import each


@pytest.fixture(autouse=True)
def processors(monkeypatch):
    monkeypatch.setattr(parallel.os, "cpu_count", lambda: 3)


def test_results_come_in_the_order_of_the_items():
    waiting = threading.Barrier(3, timeout=30)  # three run at the same time

    def work(item):
        waiting.wait()
        return item**2

    assert each(work, range(6)) == [0, 1, 4, 9, 16, 25]
    assert each(work, []) == []


def test_a_single_item_is_done_where_it_is_asked_for():
    assert each(lambda item: threading.current_thread(), [0]) == [threading.current_thread()]


def test_what_an_item_raises_is_raised_and_those_that_wait_are_not_begun():
    begun = []

    def work(item):
        begun.append(item)
        if item:
            # Long enough for the caller to hear of the first one, however busy the machine is.
            time.sleep(0.05)
        raise ValueError(f"item {item}")

    with pytest.raises(ValueError, match="item 0"):
        each(work, range(1000))
    assert len(begun) < 1000
    assert threading.active_count() == 1 + len([t for t in threading.enumerate() if t.daemon])


@pytest.mark.parametrize("searches", [True, False])
def test_no_garbage_is_searched_meanwhile_and_it_is_afterwards_if_it_was_before(searches):
    (gc.enable if searches else gc.disable)()
    try:
        assert each(lambda item: gc.isenabled(), range(4)) == [False] * 4
        assert gc.isenabled() == searches
        with pytest.raises(ZeroDivisionError):
            each(lambda item: 1 // item, range(4))
        assert gc.isenabled() == searches
    finally:
        gc.enable()
