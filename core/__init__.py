"""The three-parameter 9-point subdivision scheme: exact masks, limit curves, documents, files.

NumPy only: it runs without a screen. What reads and writes files is imported from
``core.store`` and ``core.formats``, so that the mathematics loads alone.
"""

from core.arcs import Arcs, arcs
from core.atlas import Plane, Quantity, parameter_map, smoothest_beta
from core.basis import BasicLimitFunction
from core.beziers import Beziers, beziers
from core.cells import Interval
from core.continuity import Certificate, Convergence, Smoothness, certificate, smoothness
from core.document import Curve, Document
from core.ends import end_points, end_rules, extended
from core.errors import FileError, NinepointError, NoLimitError, ParameterError, SmoothnessError
from core.family import PRESETS, Parameters, displacement, exact, one_parameter, two_parameter
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
from core.view import view

__all__ = [
    "PRESETS",
    "Arcs",
    "BasicLimitFunction",
    "Beziers",
    "Certificate",
    "Convergence",
    "Curve",
    "CurvePyramid",
    "Document",
    "FileError",
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
    "step_gibbs",
    "subdivide",
    "tangents",
    "two_parameter",
    "view",
    "zeta_violation",
]
