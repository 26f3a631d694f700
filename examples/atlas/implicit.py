"""Error of implicit Euler alone in the three-dimensional pulses: Fourier series along an infinite bar,
one mode at a time, compared with d'Alembert's solution (suite free-bar-pulse-hencky-3d)."""

import numpy as np

AMPLITUDE, HALF_WIDTH, UNTIL = 1e-3, 0.25, 0.1
POINTS = 4096  # along 1 m


def clip(s: np.ndarray) -> np.ndarray:
    return np.clip(s, -HALF_WIDTH, HALF_WIDTH)


def integral(s: np.ndarray) -> np.ndarray:
    """Fourier coefficients of cos(pi s/(2 W))^4."""
    w, s = HALF_WIDTH, clip(s)
    return (3 / 8 * s + w / (2 * np.pi) * np.sin(np.pi * s / w)
            + w / (16 * np.pi) * np.sin(2 * np.pi * s / w))


def error(cells: int, substeps: int) -> float:
    """The root of the mean square (m) over the bar."""
    x = (np.arange(POINTS) + 0.5) / POINTS - 0.5
    dt = 0.2 / cells / substeps
    squares = (2 * np.pi * np.fft.rfftfreq(POINTS, 1 / POINTS)) ** 2
    v = np.fft.rfft(AMPLITUDE * np.cos(np.pi * clip(x) / (2 * HALF_WIDTH)) ** 4)
    u = 0 * v
    for _ in range(round(UNTIL / dt)):
        v = (v - dt * squares * u) / (1 + dt**2 * squares)
        u = u + dt * v
    exact = AMPLITUDE / 2 * (integral(x + UNTIL) - integral(x - UNTIL))
    off = (np.fft.irfft(u, POINTS) - exact)[abs(x) < 0.375]
    return float(np.sqrt(np.mean(off**2)))


if __name__ == "__main__":
    for cells in (32, 40, 48, 56):
        print(cells, *(f"{error(cells, substeps):.2e}" for substeps in (1, 2)))
