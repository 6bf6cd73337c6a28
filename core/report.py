"""Everything that is known of one member of the family, as one value."""

from __future__ import annotations

import math
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from core.basis import BasicLimitFunction
from core.cells import Interval
from core.continuity import Convergence, Effort, Smoothness, certificate, smoothness
from core.ends import end_rules
from core.errors import NoLimitError
from core.family import Parameters
from core.gibbs import (
    ZETA_ITERATIONS,
    Gibbs,
    StepResponse,
    Violation,
    falls_monotonically,
    ramp_gibbs,
    step_gibbs,
    zeta_violation,
)
from core.mask import Mask, Stencil
from core.polytope import Cancelled, never
from core.profile import Profile, profile
from core.reproduction import generation_degree, reproduction_degree


@dataclass(frozen=True)
class Report:
    """The exact report on a scheme (theory, sections 3 to 9).

    Attributes
    ----------
    parameters
        The member.
    mask
        Its mask, trimmed.
    multiplicity
        Full multiplicity of (1+z) in the symbol.
    support
        Ends of the support of phi in t.
    generation_degree, reproduction_degree
        Degrees of polynomials generated and reproduced.
    smoothness
        Class and Hölder interval; the norm of the certificate is exact.
    step, ramp
        Excess of the responses to a jump and to a kink.
    is_free_of_gibbs
        Whether it is proven that the step response falls all the way.
    ringing_length
        Distance from the jump at which the step response has settled to 0.1 %, in spans.
    violation
        First violation of the zeta criterion for k up to `core.gibbs.ZETA_ITERATIONS`, or None.
    profile
        Height, depth, lobes and integral of phi; None where there is no limit.
    limit_stencil, tangent_stencil
        Exact weights of the control points in ``C(i)`` and ``C'(i)``; None where there is no limit,
        or where C^1 is not proven.
    end_rules
        Rules near the start of an open polygon; empty where the ends cannot be placed.
    """

    parameters: Parameters
    mask: Mask
    multiplicity: int
    support: tuple[Fraction, Fraction]
    generation_degree: int
    reproduction_degree: int
    smoothness: Smoothness
    step: Gibbs
    ramp: Gibbs
    is_free_of_gibbs: bool
    ringing_length: float
    violation: Violation | None
    profile: Profile | None
    limit_stencil: Stencil | None
    tangent_stencil: Stencil | None
    end_rules: tuple[tuple[Fraction, ...], ...]

    @property
    def zeta_nonnegative_up_to(self) -> int:
        """Largest k for which no partial sum of Theorem 2.2 is negative, as far as evaluated."""
        return ZETA_ITERATIONS if self.violation is None else self.violation.iterations - 1

    @property
    def place_in_family(self) -> str:
        """Which named member or sub-scheme this is, in words."""
        p = self.parameters
        if p.name is not None:
            return f"the preset {p.name}"
        if p.alpha == p.gamma == 0:
            return "the one-parameter sub-scheme (0, beta, 0)"
        if p.alpha == p.gamma:
            return "the two-parameter sub-scheme (alpha, beta, alpha)"
        return "the full family"


def report(parameters: Parameters, cancelled: Cancelled = never) -> Report:
    """Compute the report; under a second for all members of moderate size.

    Parameters
    ----------
    parameters
        Any member, convergent or not: what does not exist is None or empty, bounds that are not
        proven are infinite.
    cancelled
        Asked now and then; True ends the narrowing of the Hölder interval.
    """
    mask = parameters.mask
    smooth = smoothness(mask, Effort.FULL, cancelled)
    exact = Smoothness(certificate(mask, exact=True), smooth.exponent, smooth.not_class)
    phi = BasicLimitFunction(mask)
    limit: Stencil | None = None
    rules: tuple[tuple[Fraction, ...], ...] = ()
    ringing = math.inf
    shape: Profile | None = None
    if exact.convergence is not Convergence.DISPROVEN:
        # Even where no divergence is proven there may be no unique limit; then these stay empty.
        with suppress(NoLimitError):
            limit = phi.limit_stencil()
            rules = end_rules(mask)
            shape = profile(mask)
            ringing = StepResponse(mask).ringing_length
    has_tangent = limit is not None and exact.order is not None and exact.order >= 1
    return Report(
        parameters=parameters,
        mask=mask,
        multiplicity=mask.factored()[0],
        support=phi.support,
        generation_degree=generation_degree(mask),
        reproduction_degree=reproduction_degree(mask),
        smoothness=exact,
        step=step_gibbs(mask),
        ramp=ramp_gibbs(mask),
        is_free_of_gibbs=falls_monotonically(mask),
        ringing_length=ringing,
        violation=zeta_violation(mask),
        profile=shape,
        limit_stencil=limit,
        tangent_stencil=phi.tangent_stencil() if has_tangent else None,
        end_rules=rules,
    )


def as_json(report: Report) -> dict[str, Any]:
    """The report as plain data for JSON: fractions as strings, bounds not proven as null."""
    p, smooth = report.parameters, report.smoothness
    proof, violation = smooth.certificate, report.violation
    limit = report.limit_stencil
    return {
        "parameters": {
            "alpha": str(p.alpha),
            "beta": str(p.beta),
            "gamma": str(p.gamma),
            "neighbours": p.neighbours,
        },
        "mask": {
            "start": report.mask.start,
            "coefficients": [str(c) for c in report.mask.coefficients],
        },
        "support": [str(end) for end in report.support],
        "one_plus_z_multiplicity": report.multiplicity,
        "generation_degree": report.generation_degree,
        "reproduction_degree": report.reproduction_degree,
        "continuity": {
            "class": proof.order,
            "iterations": proof.iterations,
            "norm": None if proof.norm is None else float(proof.norm),
            "not_class": smooth.not_class,
        },
        "hoelder": {"lower": smooth.exponent.lower, "upper": smooth.exponent.upper},
        "gibbs": {
            "overshoot": _ends(report.step.overshoot),
            "undershoot": _ends(report.step.undershoot),
            "zeta_nonnegative_up_to": report.zeta_nonnegative_up_to,
            "first_violation": violation
            and {
                "iterations": violation.iterations,
                "residue": violation.residue,
                "index": violation.index,
                "value": str(violation.value),
            },
        },
        "limit_stencil": limit
        and {"offsets": list(limit.offsets), "weights": [str(w) for w in limit.weights]},
        "endpoint_rules": [[str(weight) for weight in row] for row in report.end_rules],
    }


def _ends(interval: Interval) -> list[float | None]:
    return [interval.lower, interval.upper if math.isfinite(interval.upper) else None]
