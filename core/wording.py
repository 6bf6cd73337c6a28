"""The report in words and formulas: plain text and LaTeX."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Final

from core.cells import WIDTH, Interval
from core.continuity import Convergence
from core.gibbs import ZETA_ITERATIONS, Gibbs
from core.mask import Stencil
from core.report import Report

_LONGEST_FRACTION: Final = 24
"""Longest fraction that is written out; longer ones are rounded to 10 decimals, and say so."""

_SUPERSCRIPTS: Final = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")


def class_name(order: int) -> str:
    """``C³`` for 3."""
    return "C" + str(order).translate(_SUPERSCRIPTS)


def class_statement(report_class: int | None, not_class: int, convergence: Convergence) -> str:
    """What is proven of the class, in one line: ``C³ proven, not C⁴``."""
    if convergence is Convergence.DISPROVEN:
        return "does not converge, proven"
    if report_class is None:
        return "convergence undecided"
    if not_class == report_class + 1:
        return f"{class_name(report_class)} proven, not {class_name(not_class)}"
    return f"{class_name(report_class)} proven"


def percentage(interval: Interval) -> str:
    """An excess in percent, in as many digits as are proven; zero as "none seen above ..."."""
    if math.isinf(interval.upper):
        seen = f"at least {100 * interval.lower:.4g} %, " if interval.lower > 0 else ""
        return seen + "no bound proven"
    if interval.upper == 0:
        return "none, proven"
    if interval.upper <= 2 * WIDTH and interval.lower < WIDTH / 10:
        return f"none seen above {interval.upper:.0e}"
    return f"{100 * interval.lower:.7f} %"


def as_text(report: Report) -> str:
    """The report for a person, in lines of plain text.

    Long fractions of the limit and tangent stencils are rounded there; the JSON report has them in
    full.
    """
    lines: list[str] = []
    for title, rows in sections(report):
        lines += [title, *(f"  {row}" for row in rows), ""]
    return "\n".join(lines).rstrip() + "\n"


def sections(report: Report) -> list[tuple[str, list[str]]]:
    """The report as pairs of a title and its rows, for a view that sets them itself."""
    p, mask = report.parameters, report.mask
    low, high = report.support
    return [
        (
            f"Scheme ({p.alpha}, {p.beta}, {p.gamma}), {p.neighbours} neighbours",
            [
                report.place_in_family,
                f"mask a_{mask.start} .. a_{mask.end}: " + ", ".join(map(str, mask.coefficients)),
                f"even rule: {_combination(mask.even)}",
                f"odd rule:  {_combination(mask.odd)}",
                "both rules sum to 1; the symbol has the factor (1+z)^" + str(report.multiplicity),
                f"support of phi: t = {low} .. {high}, width {high - low}",
                _degrees(report),
            ],
        ),
        ("Smoothness", _smoothness(report)),
        ("Step response and ramp", _gibbs(report)),
        ("Basic limit function", _basis(report)),
        ("Limit at a control point", _limit(report)),
        ("Rules at the start of an open polygon", _end_rules(report)),
    ]


def _degrees(report: Report) -> str:
    generated, reproduced = report.generation_degree, report.reproduction_degree
    return f"generates degree {generated}, reproduces degree {reproduced}"


def _smoothness(report: Report) -> list[str]:
    smooth = report.smoothness
    proof, exponent = smooth.certificate, smooth.exponent
    lines = [class_statement(smooth.order, smooth.not_class, smooth.convergence)]
    if proof.norm is not None:
        lines.append(
            f"Theorem 2.1: {class_name(proof.order or 0)} by a norm of {float(proof.norm):.6f}"
            f" at L = {proof.iterations}, exact {_fraction(Fraction(proof.norm))}"
        )
    else:
        lines.append("Theorem 2.1: no norm below 1 for L up to 10")
    digits = 6 if exponent.width < 1e-6 else 4
    lines.append(
        f"Hölder exponent between {_down(exponent.lower, digits)} and {_up(exponent.upper, digits)}"
        + (f", maximal product B_{exponent.product}" if exponent.product else "")
    )
    return lines


def _gibbs(report: Report) -> list[str]:
    step, ramp = report.step, report.ramp
    lines = [
        f"overshoot {percentage(step.overshoot)}; undershoot {percentage(step.undershoot)}",
        f"ramp: {_number(ramp.overshoot)} above the kink, {_number(ramp.undershoot)} below it",
    ]
    if math.isfinite(report.ringing_length):
        lines.append(f"settled to 0.1 % from {report.ringing_length:.3f} spans off the jump")
    if report.is_free_of_gibbs:
        lines.append("no Gibbs effect, proven: the scheme for differences has no negative weight")
    elif _is_quiet(step):
        lines.append("no Gibbs effect seen; that there is none is not proven")
    violation = report.violation
    if violation is None:
        lines.append(f"Theorem 2.2: no negative partial sum for k = 1 .. {ZETA_ITERATIONS}")
    else:
        lines.append(
            f"Theorem 2.2: zeta_{violation.residue}^[{violation.iterations}]({violation.index})"
            f" = {_fraction(violation.value)} < 0"
        )
    return lines


def _basis(report: Report) -> list[str]:
    found = report.profile
    if found is None:
        return ["there is none"]
    lines = [f"height {_number(found.height)}, integral {found.integral}"]
    if not found.negative_lobes:
        lines.append("not negative, proven" if found.depth.upper == 0 else "no negative lobe seen")
        return lines
    lobes = ", ".join(f"{left:.2f} .. {right:.2f}" for left, right in found.negative_lobes)
    return [*lines, f"depth {_number(found.depth)}; negative for t in {lobes}"]


def _limit(report: Report) -> list[str]:
    if report.limit_stencil is None:
        return ["there is no limit"]
    lines = [f"C(i)  = {_combination(report.limit_stencil)}"]
    if report.tangent_stencil is None:
        lines.append("C'(i): not proven to exist")
    else:
        lines.append(f"C'(i) = {_combination(report.tangent_stencil)}")
    return lines


def _end_rules(report: Report) -> list[str]:
    if not report.end_rules:
        return ["the ends cannot be placed"]
    return [
        f"P_{m} = {_combination(Stencil.from_mapping(dict(enumerate(row))), absolute=True)}"
        for m, row in enumerate(report.end_rules)
    ]


def _is_quiet(gibbs: Gibbs) -> bool:
    return max(gibbs.overshoot.upper, gibbs.undershoot.upper) <= 2 * WIDTH


def _number(interval: Interval) -> str:
    return "unbounded" if math.isinf(interval.upper) else f"{interval.lower:.6f}"


def _down(value: float, digits: int) -> str:
    return f"{math.floor(value * 10**digits) / 10**digits:.{digits}f}"


def _up(value: float, digits: int) -> str:
    return f"{math.ceil(value * 10**digits) / 10**digits:.{digits}f}"


def _fraction(value: Fraction) -> str:
    text = str(value)
    return text if len(text) <= _LONGEST_FRACTION else f"{float(value):.10f}..."


def _combination(stencil: Stencil, absolute: bool = False) -> str:
    """``1/2 p_{i-1} + 1/2 p_i``, or with indices p_0, p_1 when absolute."""
    terms = ""
    for offset, weight in stencil.items():
        if weight == 0:
            continue
        relative = "p_i" if offset == 0 else f"p_i{offset:+d}"
        point = f"p_{offset}" if absolute else relative
        sign = "-" if weight < 0 else "+"
        terms += f" {sign} {_fraction(abs(weight))} {point}"
    return terms[3:] if terms.startswith(" + ") else terms[1:].replace("- ", "-", 1)


def as_latex(report: Report) -> str:
    """The report as LaTeX, for a paper: an ``align*`` of its formulas and a sentence each.

    It needs amsmath only.
    """
    p, mask, smooth = report.parameters, report.mask, report.smoothness
    low, high = report.support
    member = f"({_tex(p.alpha)}, {_tex(p.beta)}, {_tex(p.gamma)})"
    rows = [
        rf"(\alpha, \beta, \gamma) &= {member}\quad\text{{({p.neighbours})}}",
        r"a(z) &= (1+z)^{" + str(report.multiplicity) + "} q(z)",
        rf"\operatorname{{supp}}\phi &= \left[{_tex(low)}, {_tex(high)}\right]",
        *(
            rf"P_{{2i{'+1' if parity else ''}}} &= {_tex_combination(mask.stencil(parity))}"
            for parity in (0, 1)
        ),
    ]
    proof = smooth.certificate
    if proof.norm is not None and proof.iterations is not None:
        rows.append(
            rf"\bigl\|b^{{[{proof.iterations}]}}\bigr\|_\infty &= {float(proof.norm):.6f} < 1"
            rf"\quad\Rightarrow\quad C^{{{proof.order}}}"
        )
    rows.append(rf"{_down(smooth.exponent.lower, 6)} &\le H \le {_up(smooth.exponent.upper, 6)}")
    for name, interval in (
        (r"\max S - 1", report.step.overshoot),
        (r"-\min S", report.step.undershoot),
    ):
        upper = r"\infty" if math.isinf(interval.upper) else f"{interval.upper:.10f}"
        rows.append(rf"{interval.lower:.10f} &\le {name} \le {upper}")
    if report.limit_stencil is not None:
        rows.append(rf"C(i) &= {_tex_combination(report.limit_stencil)}")
    return "\\begin{align*}\n" + " \\\\\n".join(rows) + "\n\\end{align*}\n"


def _tex(value: Fraction) -> str:
    if value.denominator == 1:
        return str(value)
    if len(str(value)) > _LONGEST_FRACTION:
        return f"{float(value):.10f}"
    sign = "-" if value < 0 else ""
    return rf"{sign}\tfrac{{{abs(value.numerator)}}}{{{value.denominator}}}"


def _tex_combination(stencil: Stencil) -> str:
    terms = ""
    for offset, weight in stencil.items():
        if weight:
            index = "i" if offset == 0 else f"i{offset:+d}"
            terms += f" {'-' if weight < 0 else '+'} {_tex(abs(weight))}\\,p_{{{index}}}"
    return terms.removeprefix(" + ").strip()
