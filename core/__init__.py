"""The three-parameter 9-point subdivision scheme: exact masks, limit curves, documents, files.

NumPy only: it runs without a screen. What reads and writes files is imported from
``core.store`` and ``core.formats``, so that the mathematics loads alone.

Each name is loaded when it is first asked for (PEP 562): ``from core.errors import NinepointError``
costs neither numpy nor the rest, and a window's first paint loads only what it draws with.
"""

from __future__ import annotations

import sys
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from core.affine import Affine
    from core.arcs import Arcs, arcs
    from core.atlas import Plane, Quantity, parameter_map, smoothest_beta
    from core.basis import BasicLimitFunction
    from core.beziers import Beziers, beziers
    from core.blocks import Blocks
    from core.cells import Interval
    from core.continuity import Certificate, Convergence, Smoothness, certificate, smoothness
    from core.document import Curve, Document
    from core.ends import end_points, end_rules, extended
    from core.errors import FileError, NinepointError, NoLimitError, ParameterError, SmoothnessError
    from core.family import PRESETS, Parameters, displacement, exact, one_parameter, two_parameter
    from core.fit import Fit, fit
    from core.flatten import Polyline, polyline
    from core.gibbs import Gibbs, StepResponse, Violation, ramp_gibbs, step_gibbs, zeta_violation
    from core.history import History
    from core.hoelder import HoelderInterval, branch_and_bound, exact_interval, quick_interval
    from core.limit import LimitCurve
    from core.live import LiveCurve
    from core.mask import Mask, Stencil
    from core.parents import bspline, lagrange
    from core.picking import nearest_place, nearest_point, points_within
    from core.pull import control_weights, pull, pulled
    from core.pyramid import CurvePyramid, PolygonPyramid, Pyramid
    from core.refine import refine, subdivide
    from core.report import Report, report
    from core.reproduction import generation_degree, reproduction_degree
    from core.runs import Runs
    from core.shape import curvatures, second_derivatives, tangents
    from core.splines import Spline, spline
    from core.view import view

__all__ = [
    "PRESETS",
    "Affine",
    "Arcs",
    "BasicLimitFunction",
    "Beziers",
    "Blocks",
    "Certificate",
    "Convergence",
    "Curve",
    "CurvePyramid",
    "Document",
    "FileError",
    "Fit",
    "Gibbs",
    "History",
    "HoelderInterval",
    "Interval",
    "LimitCurve",
    "LiveCurve",
    "Mask",
    "NinepointError",
    "NoLimitError",
    "ParameterError",
    "Parameters",
    "Plane",
    "PolygonPyramid",
    "Polyline",
    "Pyramid",
    "Quantity",
    "Report",
    "Runs",
    "Smoothness",
    "SmoothnessError",
    "Spline",
    "Stencil",
    "StepResponse",
    "Violation",
    "arcs",
    "beziers",
    "branch_and_bound",
    "bspline",
    "certificate",
    "control_weights",
    "curvatures",
    "displacement",
    "end_points",
    "end_rules",
    "exact",
    "exact_interval",
    "extended",
    "fit",
    "generation_degree",
    "lagrange",
    "nearest_place",
    "nearest_point",
    "one_parameter",
    "parameter_map",
    "points_within",
    "polyline",
    "pull",
    "pulled",
    "quick_interval",
    "ramp_gibbs",
    "refine",
    "report",
    "reproduction_degree",
    "second_derivatives",
    "smoothest_beta",
    "smoothness",
    "spline",
    "step_gibbs",
    "subdivide",
    "tangents",
    "two_parameter",
    "view",
    "zeta_violation",
]

_NAMES = {
    "affine": "Affine",
    "arcs": "Arcs arcs",
    "atlas": "Plane Quantity parameter_map smoothest_beta",
    "basis": "BasicLimitFunction",
    "beziers": "Beziers beziers",
    "blocks": "Blocks",
    "cells": "Interval",
    "continuity": "Certificate Convergence Smoothness certificate smoothness",
    "document": "Curve Document",
    "ends": "end_points end_rules extended",
    "errors": "FileError NinepointError NoLimitError ParameterError SmoothnessError",
    "family": "PRESETS Parameters displacement exact one_parameter two_parameter",
    "fit": "Fit fit",
    "flatten": "Polyline polyline",
    "gibbs": "Gibbs StepResponse Violation ramp_gibbs step_gibbs zeta_violation",
    "history": "History",
    "hoelder": "HoelderInterval branch_and_bound exact_interval quick_interval",
    "limit": "LimitCurve",
    "live": "LiveCurve",
    "mask": "Mask Stencil",
    "parents": "bspline lagrange",
    "picking": "nearest_place nearest_point points_within",
    "pull": "control_weights pull pulled",
    "pyramid": "CurvePyramid PolygonPyramid Pyramid",
    "refine": "refine subdivide",
    "report": "Report report",
    "reproduction": "generation_degree reproduction_degree",
    "runs": "Runs",
    "shape": "curvatures second_derivatives tangents",
    "splines": "Spline spline",
    "view": "view",
}
"""What is public, by the module that defines it."""

_HOMES = {name: module for module, names in _NAMES.items() for name in names.split()}


if not TYPE_CHECKING:  # else any name at all would pass for a public one

    def __getattr__(name: str) -> Any:
        """Load a public name from its module."""
        if name not in _HOMES:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        value = getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)
        setattr(sys.modules[__name__], name, value)  # the next one finds it without asking
        return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})


class _Core(ModuleType):
    """The package as a module in which ``core.arcs`` is the function, whatever was loaded before.

    The import system binds each submodule to its package when it is loaded. Where a public
    function bears the name of its module, that would hide the function.
    """

    def __setattr__(self, name: str, value: object) -> None:
        if name not in _HOMES or not isinstance(value, ModuleType):
            super().__setattr__(name, value)


sys.modules[__name__].__class__ = _Core
