from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from PySide6.QtWidgets import QApplication

from app.chart import RAMPS, Chart, Scale
from app.style import DARK, LIGHT, contrast
from app.theme import window_palette
from core.atlas import Plane

SCALE = Scale("Height", 0, 4, 1, str)
PLANE = Plane(
    (Fraction(0),) * 3, (1, 0, 0), (0, 1, 0), (Fraction(0), Fraction(1)), (Fraction(0), Fraction(2))
)


@pytest.fixture
def chart(qtbot):
    QApplication.setPalette(window_palette(LIGHT))
    chart = Chart()
    qtbot.addWidget(chart)
    chart.resize(300, 300)
    chart.show()
    return chart


def pixel(chart, u, v):
    return chart.grab().toImage().pixelColor(chart.place_px(u, v).toPoint()).name()


@pytest.mark.parametrize("colours", [LIGHT, DARK])
def test_values_have_the_colours_of_the_ramp_with_v_upwards(chart, colours):
    QApplication.setPalette(window_palette(colours))
    QApplication.processEvents()
    chart.show_map(PLANE, np.array([[0.0, 1.0], [2.0, 4.0]]), SCALE)
    ramp = RAMPS[colours is LIGHT]
    assert pixel(chart, 0.25, 0.5) == ramp[0]
    assert pixel(chart, 0.75, 0.5) == ramp[1]
    assert pixel(chart, 0.25, 1.5) == ramp[2]
    assert pixel(chart, 0.75, 1.5) == ramp[4]


@pytest.mark.parametrize("ramp", RAMPS.values())
def test_the_lightness_of_a_ramp_runs_one_way(ramp):
    steps = [contrast(ramp[0], name) for name in ramp]
    assert steps == sorted(steps)
    assert all(contrast(one, following) > 1.4 for one, following in pairwise(ramp))


def test_unknown_values_are_empty_and_low_ones_grey(chart):
    chart.show_map(PLANE, np.array([[np.nan, -1.0], [9.0, 0.0]]), SCALE)
    assert pixel(chart, 0.25, 0.5) == LIGHT.plot_background
    assert pixel(chart, 0.75, 0.5) == LIGHT.axis
    assert pixel(chart, 0.25, 1.5) == RAMPS[True][-1]


def test_the_value_at_the_cross(chart):
    chart.show_map(PLANE, np.array([[0.0, 1.0], [2.0, np.nan]]), SCALE)
    assert chart.value_here() is None
    chart.mark((0.1, 1.9))
    assert chart.value_here() == 2
    chart.mark((1.0, 2.0))
    assert np.isnan(chart.value_here())
    chart.mark((1.1, 0.0))
    assert chart.value_here() is None


def test_places_are_snapped_to_the_steps_of_the_sliders(chart):
    assert chart.snapped(0.2519, -0.7499) == (Fraction(1, 4), Fraction(-3, 4))


def test_an_empty_chart_can_be_painted(chart):
    chart.grab()
    chart.resize(10, 10)
    chart.grab()
