"""Error of implicit Euler alone in the three-dimensional pulses: Fourier series along an infinite bar,
one mode at a time, compared with d'Alembert's solution (suite free-bar-pulse-hencky-3d)."""

import numpy as np

AMPLITUDE, HALF_WIDTH, UNTIL = 1e-3, 0.25, 0.1
POINTS = 4096  # along 1 m


def error(cells: int, substeps: int) -> float:
    """The root of the mean square (m) over the bar."""
    x = (np.arange(POINTS) + 0.5) / POINTS - 0.5
    dt = 0.2 / cells / substeps
    k = 2 * np.pi * np.fft.rfftfreq(POINTS, 1 / POINTS)
    start = v = np.fft.rfft(AMPLITUDE * np.cos(np.pi / 2 * np.clip(x / HALF_WIDTH, -1, 1)) ** 4)
    u = 0 * v
    for _ in range(round(UNTIL / dt)):
        v = (v - dt * k**2 * u) / (1 + dt**2 * k**2)
        u = u + dt * v
    exact = start * UNTIL * np.sinc(k * UNTIL / np.pi)
    return float(np.sqrt(np.mean(np.fft.irfft(u - exact, POINTS)[abs(x) < 0.375] ** 2)))


if __name__ == "__main__":
    for cells in (32, 40, 48, 56):
        print(cells, *(f"{error(cells, substeps):.2e}" for substeps in (1, 2)))
