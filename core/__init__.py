"""The three-parameter 9-point subdivision scheme: exact masks, limit curves, documents, files.

NumPy only: it runs without a screen.
"""

from core.basis import BasicLimitFunction
from core.document import Curve, Document
from core.ends import end_points, extended
from core.errors import FileError, NinepointError, NoLimitError, ParameterError
from core.family import PRESETS, Parameters, displacement, exact, one_parameter, two_parameter
from core.gibbs import StepResponse
from core.history import History
from core.limit import LimitCurve
from core.mask import Mask, Stencil
from core.parents import bspline, lagrange
from core.refine import refine, subdivide

__all__ = [
    "PRESETS",
    "BasicLimitFunction",
    "Curve",
    "Document",
    "FileError",
    "History",
    "LimitCurve",
    "Mask",
    "NinepointError",
    "NoLimitError",
    "ParameterError",
    "Parameters",
    "Stencil",
    "StepResponse",
    "bspline",
    "displacement",
    "end_points",
    "exact",
    "extended",
    "lagrange",
    "one_parameter",
    "refine",
    "subdivide",
    "two_parameter",
]
