"""Scaling collapse of flow curves around jamming, by a scan and least squares; numpy alone.

The stress (or pressure) near jamming is taken as sigma = rate^q f(x), x = (phi - phi_J) / rate^(1/z nu), with a
polynomial for ln f: Olsson and Teitel, Phys. Rev. Lett. 99, 178001 (2007) and Phys. Rev. E 83, 030302 (2011). Then ln
sigma is linear in q and in the coefficients of the polynomial, so that a scan is needed over phi_J and 1/z nu alone.
In the form of 2007, rate / sigma = |phi - phi_J|^beta g(sigma / |phi - phi_J|^Delta), it is Delta = q z nu and
beta = (1 - q) z nu.
"""
import numpy as np

PHI_J = np.arange(0.8340, 0.85205, 0.0005)      # the scan; then a finer one around the best
INVERSE = np.arange(0.14, 0.621, 0.02)          # 1 / z nu
DEGREE = 4                                      # of the polynomial


class Collapse:
    """The best collapse of points: phi, rate, value and the error of ln value, each an array."""

    def __init__(self, phi, rate, value, error, degree=DEGREE):
        self.points = len(phi)
        wanted = np.log(value) / error

        def columns(x):
            """Of the linear fits, one for each row of x; powers of numbers up to 1, for a good condition."""
            scaled = x / np.abs(x).max(axis=1, keepdims=True)
            powers = [scaled**k for k in range(degree + 1)]
            return np.stack([np.broadcast_to(np.log(rate), x.shape), *powers], axis=2) / error[:, None]

        def scan(phi_j, inverse):
            """The least sum of squares over a grid, and where it is."""
            phi_j, inverse = (axis.reshape(-1, 1) for axis in np.meshgrid(phi_j, inverse))
            q = np.linalg.qr(columns((phi - phi_j) / rate**inverse))[0]
            left = wanted - np.einsum("gnk,gk->gn", q, np.einsum("gnk,n->gk", q, wanted))
            squares = (left**2).sum(1)
            best = squares.argmin()
            return squares[best], phi_j[best, 0], inverse[best, 0]

        _, phi_j, inverse = scan(PHI_J, INVERSE)
        self.at_edge = phi_j in PHI_J[[0, -1]] or inverse in INVERSE[[0, -1]]
        squares, self.phi_j, self.inverse = scan(phi_j + 0.0001 * np.arange(-5, 6), inverse + 0.005 * np.arange(-4, 5))
        x = (phi - self.phi_j) / rate**self.inverse
        self.width = np.abs(x).max()
        self.q, *self.shape = np.linalg.lstsq(columns(x[None])[0], wanted, rcond=None)[0]
        self.chi2 = squares / (self.points - degree - 4)        # by degree + 1 coefficients, q, phi_J, 1 / z nu
        self.delta, self.beta = self.q / self.inverse, (1 - self.q) / self.inverse

    def curve(self, x):
        """f(x)"""
        return np.exp(sum(c * (x / self.width)**k for k, c in enumerate(self.shape)))

    def numbers(self):
        return np.array([self.phi_j, self.q, self.inverse, self.beta, self.delta])


def bootstrap(phi, rate, value, error, degree=DEGREE, times=100, seed=1):
    """Standard deviations of phi_J, q, 1/z nu, beta, Delta: collapses of points drawn with replacement.

    And the part of these whose minimum is at the edge of the scan.
    """
    random = np.random.default_rng(seed)
    found = []
    for _ in range(times):
        drawn = random.integers(0, len(phi), len(phi))
        found.append(Collapse(phi[drawn], rate[drawn], value[drawn], error[drawn], degree))
    return np.std([one.numbers() for one in found], axis=0, ddof=1), np.mean([one.at_edge for one in found])
