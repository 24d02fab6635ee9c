"""Derivatives on uniform grids as full matrices, from their definitions."""

import numpy as np


def points(n: int, length: float, boundary: str = "periodic") -> np.ndarray:
    dx = length / n
    if boundary == "dirichlet":
        return dx * np.arange(1, n)
    return dx * (np.arange(1, n + 1) - (0.5 if boundary == "neumann" else 0))


def laplacian(n: int, length: float, boundary: str = "periodic") -> np.ndarray:
    size = n - 1 if boundary == "dirichlet" else n
    L = -2 * np.eye(size) + np.eye(size, k=1) + np.eye(size, k=-1)
    if boundary == "periodic":
        L[0, -1] = L[-1, 0] = 1
    if boundary == "neumann":
        L[0, 0] = L[-1, -1] = -1
    return L / (length / n) ** 2


def by_wave_number(n: int, length: float, symbol) -> np.ndarray:
    """The real matrix that multiplies the Fourier mode of wave number k by symbol(k); an odd symbol drops the Nyquist mode."""
    k = 2 * np.pi * np.fft.fftfreq(n, d=length / n)
    s = np.array([complex(symbol(x)) for x in k])
    if n % 2 == 0 and s[1].imag != 0:
        s[n // 2] = 0
    return np.real(np.fft.ifft(s[:, None] * np.fft.fft(np.eye(n), axis=0), axis=0))


def derivative(n: int, length: float, order: int = 1) -> np.ndarray:
    return by_wave_number(n, length, lambda k: (1j * k) ** order)
