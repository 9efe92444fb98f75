#!/usr/bin/env python3
"""Compute the reference numbers of the YAML files anew, without LAMMPS.

    python3 check_yaml.py [tests/FILE.yaml ...]      (default: all of tests/)

LAMMPS' testers write their reference numbers themselves (option -u), so they only show that the
styles go on giving what they gave then. This brute-force model in NumPy, all pairs over all
periodic images, shows that it was right: forces, energy and virial for the pair tests, and whole
adaptive integrations (positions, velocities and the global vector of the fix) for the fix tests.
It prints the largest deviation of each file and fails if one exceeds 1e-11 of the largest value
of its kind, or if the steps accepted, refused or evaluations differ.
"""
import math
from pathlib import Path
import re
import sys

import numpy as np
import yaml

HERE = Path(__file__).resolve().parent / "tests"
SAME = 1e-11
DAMPING = 1.0       # epsilon of the Chebyshev polynomials


class Foam:
    """Bubbles from a data file, and the styles' settings from the commands of a YAML file."""

    def __init__(self, config):
        commands = config["pre_commands"] + "\n" + config["post_commands"]
        self.dim = int((re.search(r"variable dim index (\d)", commands) or [0, 3])[1])
        style = config.get("pair_style") or re.search(r"variable pair_style index '(.*)'",
                                                      commands)[1]
        words = style.split()
        pair = dict(zip(words[2::2], words[3::2]))
        self.mu0, self.neighbor = float(words[1]), pair.get("drag") == "neighbor"
        coeffs = config.get("pair_coeff") or "\n".join(
            re.findall("^pair_coeff(.*)", (HERE / config["input_coeffs"]).read_text(), re.M))
        self.read_data(HERE / f"data.foam{self.dim}d")
        self.rin = float(pair.get("rin", self.R.mean()))
        self.ain = self.surface().mean()

        sigma = np.full((4, 4), np.nan)
        for line in coeffs.strip().splitlines():
            i, j, value = line.split()
            sigma[int(i), int(j)] = sigma[int(j), int(i)] = float(value)
        own = np.sqrt(np.outer(sigma.diagonal(), sigma.diagonal()))     # LAMMPS' mixing
        self.sigma = np.where(np.isnan(sigma), own, sigma)

        self.fixes = {}
        for words in map(str.split, commands.splitlines()):
            if words and words[0] == "fix":
                n = {"foam/abm": 5, "foam/rkc": 5, "foam/coarsen": 6}[words[3]]
                self.fixes[words[3]] = (words[4:n], dict(zip(words[n::2], words[n + 1::2])))
                if words[1] == "test":
                    self.tested = words[3]

    def read_data(self, path):
        text = path.read_text()
        table = {name: np.array([line.split() for line in body.strip().splitlines()], float)
                 for name, body in re.findall(r"^(Atoms|Velocities).*\n\n((?:.+\n)+)", text, re.M)}
        box = re.findall(r"^(\S+) (\S+) [xyz]lo [xyz]hi", text, re.M)
        self.L = np.array([float(hi) - float(lo) for lo, hi in box])[:self.dim]
        atoms = table["Atoms"]
        self.type, self.R, self.density = atoms[:, 1].astype(int), atoms[:, 2] / 2, atoms[:, 3]
        self.x, self.v = atoms[:, 4:4 + self.dim], table["Velocities"][:, 1:1 + self.dim]

    def surface(self):
        return 2 * np.pi * self.R if self.dim == 2 else 4 * np.pi * self.R**2

    def contacts(self):
        """i, j, vector from j to i, its length; each pair once."""
        i, j = np.triu_indices(len(self.R), 1)
        shifts = np.stack(np.meshgrid(*[[-1, 0, 1]] * self.dim), -1).reshape(-1, self.dim)
        d = (self.x[i] - self.x[j])[:, None] + shifts * self.L
        r = np.linalg.norm(d, axis=2)
        pair, image = np.nonzero(r < (self.R[i] + self.R[j])[:, None])
        return i[pair], j[pair], d[pair, image], r[pair, image]

    def springs(self):
        i, j, d, r = self.contacts()
        stiffness = self.sigma[self.type[i], self.type[j]] * self.rin
        overlap, total = self.R[i] + self.R[j] - r, self.R[i] + self.R[j]
        F = (stiffness * overlap / total / r)[:, None] * d
        force = np.zeros_like(self.x)
        np.add.at(force, i, F)
        np.add.at(force, j, -F)
        return force, (stiffness * overlap**2 / (2 * total)).sum(), d.T @ F

    def rates(self, lagged):
        """Velocities, and rates of gas content, of the present state; `lagged` are those that
        neighbor drag takes as given."""
        i, j, _, r = self.contacts()
        v = self.springs()[0] / self.mu0
        if self.neighbor:
            count, total = np.zeros(len(self.R)), np.zeros_like(self.x)
            for a, b in ((i, j), (j, i)):
                np.add.at(count, a, 1)
                np.add.at(total, a, lagged[b])
            v = v + total / np.maximum(count, 1)[:, None]
        if "foam/coarsen" not in self.fixes:
            return v, np.zeros(len(self.R))
        (K, kappa), options = self.fixes["foam/coarsen"]
        K, kappa, R = float(K), float(kappa), self.R
        a = (r**2 + R[j]**2 - R[i]**2) / (2 * r)
        h = np.where(r**2 <= abs(R[i]**2 - R[j]**2), np.minimum(R[i], R[j]),
                     np.sqrt(np.maximum(R[j]**2 - a**2, 0)))
        A = 2 * h if self.dim == 2 else np.pi * h**2
        Vdot, covered = np.zeros(len(R)), np.zeros(len(R))
        for one, other in ((i, j), (j, i)):
            np.add.at(Vdot, one, K * A * (1 / R[other] - 1 / R[one]))
            np.add.at(covered, one, A)
        weight = np.maximum(self.surface() - covered, 0)
        c = kappa * K * self.ain / self.surface().mean()
        if options.get("liquid") == "lsw":
            weight, c = weight / R, kappa * K * self.rin
        self.rho = weight.sum() / (weight / R).sum()
        return v, Vdot + c * weight * (1 / self.rho - 1 / R)

    def integrate(self, dt, runs):
        """Adaptive steps, Adams-Bashforth-Moulton's or Runge-Kutta-Chebyshev's (static drag, and the
        spectral radius given); the global vectors of both fixes."""
        style = "foam/rkc" if "foam/rkc" in self.fixes else "foam/abm"
        (tol,), abm = self.fixes[style]
        options = self.fixes.get("foam/coarsen", (0, {}))[1]
        tol, limit = float(tol), float(abm.get("dtmax", math.inf))
        source, remove = abm.get("scheme") == "source", abm.get("drift") == "remove"
        power = 1 if abm.get("variable") == "radius" else self.dim
        gas = "foam/coarsen" in self.fixes
        rmin = float(options.get("rmin", 0.1)) * self.rin if gas else 0
        ball = np.pi if self.dim == 2 else 4 * np.pi / 3
        t, h, before, accepted, refused, count = 0.0, float(abm.get("dt0", dt)), 0.0, 0, 0, 0
        removed, removed_gas, q, lag = 0, 0.0, self.R**power, self.v
        v = qdot = v1 = qdot1 = past = None
        radius, stages = float(abm.get("spectral", 0)), 0

        def as_length(gas, R):                   # of bubbles with radius R
            return gas / (self.dim * R**(self.dim - 1))
        if radius:
            limit = min(limit, stable(200) / radius)

        def rates(lagged):
            nonlocal count
            count += 1
            v, Vdot = self.rates(lagged)
            drift = v.mean(axis=0) if remove else 0
            return v - drift, Vdot / self.surface() if power == 1 else Vdot / ball

        def go_to(x, new_q):
            nonlocal q
            self.x, q = x, new_q
            if gas:
                self.R = np.maximum(q, 0)**(1 / power)

        def predictor_corrector(step):
            """The new state, and how far the corrector is from the predictor."""
            nonlocal v1, qdot1
            w = 0 if before == 0 else 1 if source else step / before
            v_past, qdot_past = past if before else (0, 0)
            x0, q0 = self.x, q
            go_to(x0 + step * ((1 + w / 2) * v - w / 2 * v_past),
                  q0 + step * ((1 + w / 2) * qdot - w / 2 * qdot_past))
            guess = self.x, self.R
            v1, qdot1 = rates(lag)
            go_to(x0 + step / 2 * (v1 + v), q0 + step / 2 * (qdot1 + qdot))
            return self.x - guess[0], self.R - guess[1]

        def stages_of(step):
            """The new state by as many stages as the step needs, and the error at the last but one."""
            nonlocal stages, v1, qdot1
            stages = next(s for s in range(3, 201) if stable(s) >= step * radius)
            first, others = chebyshev(stages)
            y0, f0, R0 = (self.x, q), (v, qdot), self.R
            older = y0
            go_to(*(y + step * first * f for y, f in zip(y0, f0)))
            for mu, nu, m, g, c in others:
                y1, R1 = (self.x, q), self.R
                v1, qdot1 = f1 = rates(lag)
                E = [(0.8 * (y - z) + 0.4 * c * step * (f + g1)) / c**3
                     for y, z, f, g1 in zip(y0, y1, f0, f1)]
                largest = np.maximum(R1, R0)
                lasting = np.where(R1 > 0, largest, np.maximum(largest, self.rin))
                gas_error = np.maximum(y1[1] + E[1], 0) - R1 if power == 1 else as_length(E[1], lasting)
                error = E[0], gas_error
                go_to(*(y + mu * (z - y) + nu * (z2 - y) + step * (m * g1 + g * f)
                        for y, z, z2, f, g1 in zip(y0, y1, older, f0, f1)))
                older = y1
            return error

        attempt = {"foam/abm": predictor_corrector, "foam/rkc": stages_of}

        for steps in runs:
            start = t
            if not source or before == 0:        # LAMMPS computes the forces before each run
                v, qdot = rates(lag)
            for _ in range(steps):
                x0, q0, again = self.x, q, False
                lag = v if source else (v + lag) / 2
                while True:
                    step = min(h, limit)
                    errors = np.abs(np.concatenate(
                        [E.ravel() for E in attempt[style](step)])) / self.rin
                    if not gas:
                        errors = errors[:self.x.size]
                    error = errors.max()
                    if abm.get("norm", "max" if source else "rms") == "rms":
                        error = math.sqrt((errors**2).mean())
                    good = error <= tol
                    most = 1000 if style == "foam/rkc" and accepted < 4 else 1.9
                    factor = min(max(0.9 * (tol / error)**(1 / 3), 0.2), most)
                    factor = min(factor, 0.9 if not good else 1 if again else most)
                    h = step * ((1.9 if good else 0.5) if source else factor)
                    if good:
                        break
                    refused, again = refused + 1, True
                    go_to(x0, q0)
                past, before, t, accepted = (v, qdot), step, t + step, accepted + 1
                v, qdot = v1, qdot1
                live = self.R >= rmin
                if not live.all():               # in these tests the last ones
                    content = ball * self.R**self.dim
                    gone = content[~live].sum()
                    removed, removed_gas = removed + (~live).sum(), removed_gas + gone
                    self.R = self.R[live] * (1 + gone / content[live].sum())**(1 / self.dim)
                    q = self.R**power
                    self.x, self.type, v, qdot, lag = (y[live] for y in (self.x, self.type, v,
                                                                         qdot, lag))
                    past = past[0][live], past[1][live]
                if not source:
                    v, qdot = rates(lag)
        self.v = v
        vectors = {style: [t, before, accepted, refused, count, error, t - start]}
        if radius:
            vectors[style] += [stages, radius]
        if not gas:
            return vectors
        tau = float(self.fixes["foam/coarsen"][0][0]) * t / self.rin**2
        phi = (ball * self.R**self.dim).sum() / self.L.prod()
        vectors["foam/coarsen"] = [tau, len(self.R), self.R.mean() / self.rin,
                                   self.R.max() / self.rin, phi, self.rho, removed, removed_gas,
                                   self.rin, self.ain]
        return vectors

    def verlet(self, dt, steps):
        """Newton's equation with the bubbles' masses, as the tester of pair styles wants it."""
        mass = (self.density * 4 / 3 * np.pi * self.R**3)[:, None]
        for _ in range(steps):
            self.v = self.v + dt / 2 * self.springs()[0] / mass
            self.x = self.x + dt * self.v
            self.v = self.v + dt / 2 * self.springs()[0] / mass


def stable(s):
    """Longest step of s stages, times the spectral radius."""
    return 2 / 3 * (1 - 2 / 15 * DAMPING) * (s * s - 1)


def chebyshev(s):
    """Of Y_1, h F_0; of Y_j: Y_{j-1} - Y_0, Y_{j-2} - Y_0, h F_{j-1}, h F_0, and c_{j-1}.  T_j(w) is
    cosh(j arcosh w)."""
    w = 1 + DAMPING / s**2
    angle, j = math.acosh(w), np.arange(s + 1)
    T = np.cosh(j * angle)
    slope = j * np.sinh(j * angle) / math.sinh(angle)
    curve = (j**2 * T - w * slope) / math.sinh(angle)**2
    w1 = slope[s] / curve[s]
    b = np.append([1.0, 1.0], curve[2:] / slope[2:]**2)
    b[:2] = b[2]
    place = np.append([0, b[1] * w1], w1 * curve[2:] / slope[2:])
    return b[1] * w1, [(2 * b[k] * w / b[k - 1], -b[k] / b[k - 2], 2 * b[k] * w1 / b[k - 1],
                        -(1 - b[k - 1] * T[k - 1]) * 2 * b[k] * w1 / b[k - 1], place[k - 1])
                       for k in range(2, s + 1)]


def numbers(text):
    return np.array([line.split() for line in text.strip().splitlines()], float)


def check(path):
    config = yaml.safe_load(path.read_text())
    foam, worst, wrong = Foam(config), 0.0, []

    def compare(name, mine, scale=None):
        nonlocal worst
        theirs = numbers(str(config[name]))
        if name.endswith(("forces", "pos", "vel")):
            theirs = theirs[:, 1:1 + foam.dim]
        if name == "run_pos":                    # the periodic image does not matter
            mine = mine - foam.L * np.round((mine - theirs) / foam.L)
        mine = np.reshape(mine, theirs.shape)
        scale = np.abs(theirs).max() if scale is None else np.maximum(np.abs(theirs), scale)
        deviation = (np.abs(mine - theirs) / scale).max()
        worst = max(worst, deviation)
        if not deviation <= SAME:
            wrong.append(f"{name} {deviation:.1e}")

    def virial(W):
        W = np.pad(W, (0, 3 - foam.dim))
        return [W[0, 0], W[1, 1], W[2, 2], W[0, 1], W[0, 2], W[1, 2]]

    if "pair_style" in config:
        for stage in "init", "run":
            if stage == "run":
                foam.verlet(float(re.search(r"^timestep +(\S+)", (HERE / config["input_file"])
                                            .read_text(), re.M)[1]), 4)
            force, energy, W = foam.springs()
            compare(f"{stage}_forces", force)
            compare(f"{stage}_vdwl", energy)
            compare(f"{stage}_stress", virial(W))
    else:
        vectors = foam.integrate(float(config["timestep"]), (0, 4, 4))
        compare("run_pos", foam.x)
        compare("run_vel", foam.v)
        vector = vectors[foam.tested]
        compare("global_vector", [len(vector)] + vector, scale=1e-3)
    print(f"{path.name}: deviation {worst:.1e}", "WRONG: " + ", ".join(wrong) if wrong else "")
    return not wrong


if __name__ == "__main__":
    files = [Path(name) for name in sys.argv[1:]] or sorted(HERE.glob("*.yaml"))
    sys.exit(not all([check(path) for path in files]))
