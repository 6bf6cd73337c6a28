"""Reference values of the theory, section 10, as test data."""

from dataclasses import dataclass

from core.family import Parameters


@dataclass(frozen=True)
class Row:
    """One member: multiplicity of 1+z, degree reproduced, certificate (class, L) and its norm,
    proven Hölder interval, overshoot and undershoot."""

    parameters: Parameters
    multiplicity: int
    reproduction: int
    certificate: tuple[int, int]
    norm: float
    hoelder: tuple[float, float]
    overshoot: float
    undershoot: float

    def __str__(self):
        p = self.parameters
        return f"{p.alpha},{p.beta},{p.gamma},{p.neighbours}"


# Two overshoots differ from the page, which prints 0.727993 for (1, 1, 1) and 0.017488 for the
# mirrored (3/10, -3/5, -1/5). The exact values at single dyadic points already exceed the first
# (0.7279962 at x = 9/512), and the proven intervals are [0.7279962171, 0.7279962173] and
# [0.0174824046, 0.0174825465]: test_gibbs.py shows both.
ROWS = [
    Row(Parameters(0, 0, 0), 7, 6, (2, 4), 0.6927, (2.838, 2.876), 0.117771, 0.117771),
    Row(Parameters(0, "-1/2", 0), 7, 1, (3, 1), 0.8573, (3.788, 3.827), 0.000310, 0.000310),
    Row(Parameters(0, "-3/4", 0), 7, 1, (4, 1), 0.907, (4.69, 4.732), 0.000015, 0.000015),
    Row(Parameters(0, -1, 0), 13, 1, (11, 1), 0.5, (12, 12), 0, 0),
    Row(
        Parameters("1/10", "-4/5", "1/10"), 7, 1, (5, 2), 0.7822, (5.563, 5.695), 0.005567, 0.005567
    ),
    Row(Parameters("1/4", "-1/2", "1/4"), 7, 3, (4, 2), 0.9392, (4.582, 4.701), 0.053287, 0.053287),
    Row(Parameters("-1/4", "-1/2", "-1/4"), 9, 1, (3, 3), 0.9103, (3.396, 3.461), 4.1e-9, 4.1e-9),
    Row(
        Parameters("-1/3", "-1/3", "-1/3"), 9, 1, (2, 3), 0.9432, (2.988, 3.053), 0.000068, 0.000068
    ),
    Row(Parameters(1, 1, 1), 7, 1, (2, 5), 0.7152, (2.767, 2.87), 0.727996, 0.727996),
    Row(Parameters("1/10", -1, "-1/10"), 8, 1, (5, 2), 0.8187, (5.439, 5.493), 0, 0.004514),
    Row(Parameters("3/10", "-3/5", "-1/5"), 7, 1, (3, 2), 0.8682, (3.734, 3.783), 0, 0.061263),
    Row(
        Parameters("1/10", -1, "-1/10", "mirrored"),
        3,
        1,
        (2, 3),
        0.9405,
        (2.361, 2.407),
        0.000234,
        0.000234,
    ),
    Row(
        Parameters("3/10", "-3/5", "-1/5", "mirrored"),
        3,
        1,
        (1, 3),
        0.934,
        (1.16, 1.2),
        0.017482,
        0.017482,
    ),
]

LIMIT_STENCILS = {
    ("0", "0", "0"): (1.034441, -0.027502, 0.013660, -0.003838, 0.000453),
    ("0", "-1", "0"): (0.378844, 0.243131, 0.061868, 0.005458, 0.000121),
    ("0", "-1/2", "0"): (0.623352, 0.164041, 0.022332, 0.001965, -0.000014),
    ("1/4", "-1/2", "1/4"): (0.578611, 0.260291, -0.036426, -0.013817, 0.000707),
}
"""Weights of p_i, p_{i+-1}, ..., p_{i+-4} in the limit point at t = i."""
