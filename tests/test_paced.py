import pytest
from PySide6.QtWidgets import QWidget

from app.paced import Paced


@pytest.fixture
def parent(qtbot):
    widget = QWidget()
    qtbot.addWidget(widget)
    return widget


@pytest.fixture
def taken(parent):
    """A list of values, and what paces those that go there."""
    values = []
    return values, Paced(values.append, 10, parent)


def test_the_first_value_is_handed_on_at_once_and_then_the_newest(qtbot, taken):
    values, paced = taken
    for value in range(5):
        paced.offer(value)
    assert values == [0]
    qtbot.waitUntil(lambda: len(values) == 2)
    assert values == [0, 4]


def test_after_a_pause_a_value_is_the_first_again(qtbot, taken):
    values, paced = taken
    paced.offer(1)
    qtbot.wait(50)
    paced.offer(2)
    assert values == [1, 2]


def test_what_is_settled_is_handed_on_at_once_and_nothing_comes_after_it(qtbot, taken):
    values, paced = taken
    paced.offer(1)
    paced.offer(2)
    paced.settle(3)
    assert values == [1, 3]
    qtbot.wait(50)
    assert values == [1, 3]
