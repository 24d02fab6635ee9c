"""Radau IIA collocation of any number of stages, steps by doubling: the integrator behind the references.

It shares no formula with Seiche: fully implicit, no exponential, no splitting, Newton on all stages at once.
"""

from __future__ import annotations

import numpy as np
from numpy.polynomial import legendre
from scipy.linalg import lu_factor, lu_solve


def radau_table(stages: int) -> tuple[np.ndarray, np.ndarray]:
    """Nodes c in (0, 1] and the matrix A of order 2·stages − 1."""
    polynomial = np.zeros(stages + 1)
    polynomial[stages], polynomial[stages - 1] = 1, -1  # P_s − P_{s−1} vanishes at the nodes
    x = np.sort(legendre.legroots(polynomial).real)
    derivative = legendre.legder(polynomial)
    for _ in range(3):
        x -= legendre.legval(x, polynomial) / legendre.legval(x, derivative)
    x[-1] = 1.0
    P = legendre.legvander(x, stages)
    integral = np.empty((stages, stages))
    integral[:, 0] = (x + 1) / 2
    for k in range(1, stages):
        integral[:, k] = (P[:, k + 1] - P[:, k - 1]) / (2 * (2 * k + 1))
    return (x + 1) / 2, np.linalg.solve(P[:, :stages].T, integral.T).T


def jacobian(rhs, t: float, z: np.ndarray, analytic: bool) -> np.ndarray:
    n = z.size
    J = np.empty((n, n))
    if analytic:
        for k in range(n):
            w = z.astype(complex)
            w[k] += 1e-100j
            J[:, k] = rhs(t, w).imag / 1e-100
        return J
    for k in range(n):
        step = 6e-6 * max(abs(z[k]), 1e-3 * np.abs(z).max(), 1e-300)
        up, down = z.copy(), z.copy()
        up[k] += step
        down[k] -= step
        J[:, k] = (rhs(t, up) - rhs(t, down)) / (up[k] - down[k])
    return J


class Radau:
    def __init__(self, rhs, stages: int, analytic: bool = True):
        self.rhs, self.stages, self.analytic = rhs, stages, analytic
        self.c, self.A = radau_table(stages)
        self.unit = 1.0

    def increment(self, t: float, z: np.ndarray, h: float, J: np.ndarray) -> np.ndarray | None:
        """z(t + h) − z, or None where Newton does not converge."""
        n, s = z.size, self.stages
        solver = lu_factor(np.eye(n * s) - h * np.kron(self.A, J))
        Z = np.zeros((s, n))
        last = np.inf
        for iteration in range(40):
            F = np.array([self.rhs(t + ci * h, z + Zi) for ci, Zi in zip(self.c, Z)])
            residual = h * self.A @ F - Z
            if not np.isfinite(residual).all():
                return None
            update = lu_solve(solver, residual.ravel()).reshape(s, n)
            Z += update
            size = np.abs(update).max()
            if size <= 4e-16 * self.unit or (iteration > 2 and size >= 0.5 * last and size <= 1e-12 * self.unit):
                return Z[-1]
            if size > 2 * last or (iteration > 20 and size > 0.5 * last):
                return None
            last = size
        return None

    def integrate(self, t0: float, t1: float, z0: np.ndarray, tolerance: float, first: float) -> np.ndarray:
        """z(t1). Each step is taken as one and as two halves; the halves are kept, in compensated sums."""
        t, z, rest, h = t0, z0.astype(float), np.zeros_like(z0, dtype=float), min(first, t1 - t0)
        order = 2 * self.stages - 1
        while t < t1:
            h = min(h, t1 - t)
            self.unit = max(np.abs(z).max(), 1e-300)
            J = jacobian(self.rhs, t, z, self.analytic)
            whole = self.increment(t, z, h, J)
            left = None if whole is None else self.increment(t, z, h / 2, J)
            right = None
            if left is not None:
                middle = z + left
                right = self.increment(t + h / 2, middle, h / 2, jacobian(self.rhs, t + h / 2, middle, self.analytic))
            if right is None:
                h /= 4
            else:
                error = np.abs(left + right - whole).max() / (tolerance * self.unit)
                if error <= 1:
                    last_one = h >= t1 - t
                    for part in (left, right):
                        y = part + rest
                        total = z + y
                        rest = y - (total - z)
                        z = total
                    t = t1 if last_one else t + h
                h *= np.clip(0.8 * max(error, 1e-30) ** (-1 / (order + 1)), 0.2, 3)
            if h < 1e-14 * max(abs(t), 1e-300):
                raise ArithmeticError(f"the step collapsed at t = {t}")
        return z
