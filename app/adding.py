"""Curves that come from elsewhere: added to the drawing in one step of undo, and selected."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from app.edits import counted, with_curves
from app.point_set import PointSet
from app.session import Selection, Session
from core.document import Document
from core.errors import NinepointError


def add_curves(session: Session, document: Document, verb: str) -> int:
    """Add the curves of another drawing, and select them.

    An empty drawing takes over the scheme that they come with; else they follow its own.

    Parameters
    ----------
    session
        The drawing.
    document
        What is added; curves without points are left out.
    verb
        What it is called in the history: "Import" becomes "Import 3 curves".

    Returns
    -------
    int
        Number of curves added.

    Raises
    ------
    NinepointError
        If there are none, or there would be too many points; nothing has changed then.
    """
    curves = [curve for curve in document.curves if curve.count]
    if not curves:
        raise NinepointError("There are no points in it.")
    session.commit()
    old = session.document
    whole = with_curves(old, curves)
    if not any(curve.count for curve in old.curves):
        whole = replace(whole, parameters=document.parameters)
    session.edit(whole, counted(verb, len(curves), "curve"))
    first = len(old.curves)
    points = {first + index: np.arange(curve.count) for index, curve in enumerate(curves)}
    session.select(Selection(PointSet(points), first))
    return len(curves)
