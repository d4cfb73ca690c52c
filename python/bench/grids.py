"""plexway.Grid beside scikit-fmm (second order) and, where it is installed, eikonalfm (factored,
second order) on closed forms: relative errors, and processor seconds, the building of a Grid
counted.

    python3 python/bench/grids.py [POINTS ALONG A SIDE IN THE PLANE, 201] [IN SPACE, 41]
"""

import importlib.util
import sys
import time

import numpy as np

import plexway


def arcosh_time(points, centre, speed, slope):
    """Arrival in a medium whose speed changes evenly: `slope` is its gradient."""
    g = np.linalg.norm(slope)
    away = np.linalg.norm(points - points[centre], axis=-1)
    return np.arccosh(1 + (g * away) ** 2 / (2 * speed[centre] * speed)) / g


def here(points, h, speed, centre, phi):
    grid = plexway.Grid(points.shape[:-1], h, speed, precision="double")
    return grid.distance(centre) if phi is None else np.abs(grid.from_level_set(phi))


def scikit_fmm(points, h, speed, centre, phi):
    import skfmm

    if phi is None:  # from a circle two points wide, as next to a point it is off by a fifth
        phi = np.linalg.norm(points - points[centre], axis=-1) - 2 * h
        inside = phi < 0
        start = 2 * h / (1 if speed is None else speed[centre])
    else:
        inside, start = np.zeros(phi.shape, bool), 0.0
    found = skfmm.distance(phi, h, order=2) if speed is None else skfmm.travel_time(phi, speed, h, order=2)
    return np.where(inside, np.nan, np.abs(np.ma.filled(found, np.nan)) + start)


def eikonalfm(points, h, speed, centre, phi):
    import eikonalfm as fm

    if phi is not None:
        return None
    medium = np.ones(points.shape[:-1]) if speed is None else speed
    axes = points.ndim - 1
    factor = fm.factored_fast_marching(medium, centre, (h,) * axes, 2)
    return factor * np.linalg.norm(points - points[centre], axis=-1)


def forms(axes, n):
    h = 1 / (n - 1)
    points = np.moveaxis(np.indices((n,) * axes), 0, -1) * h
    centre = (n // 2,) * axes
    away = np.linalg.norm(points - points[centre], axis=-1)
    yield "a point", points, h, None, centre, None, away
    corner = (0,) * axes
    yield "a corner", points, h, None, corner, None, np.linalg.norm(points, axis=-1)
    for name, slope in (("speed +1 %", 0.01), ("speed doubles", 1.0)):
        slope = np.array([slope] + [0.0] * (axes - 1))
        speed = 1 + points @ slope
        yield name, points, h, speed, centre, None, arcosh_time(points, centre, speed, slope)
    phi = away - 0.3
    yield "a circle" if axes == 2 else "a sphere", points, h, None, centre, phi, np.abs(phi)


def main():
    sides = [int(n) for n in sys.argv[1:]] + [201, 41][len(sys.argv) - 1 :]
    peers = {"plexway.Grid": here}
    for name, module, solve in (("scikit-fmm", "skfmm", scikit_fmm), ("eikonalfm", "eikonalfm", eikonalfm)):
        if importlib.util.find_spec(module):
            peers[name] = solve
        else:
            print(f"{name}: not installed, so not measured")
    print("| grid | from | program | mean error | worst error | processor, ms |")
    print("| --- | --- | --- | ---: | ---: | ---: |")
    for axes, n in zip((2, 3), sides):
        for name, points, h, speed, centre, phi, truth in forms(axes, n):
            for peer, solve in peers.items():
                began = time.process_time()
                found = solve(points, h, speed, centre, phi)
                spent = 1e3 * (time.process_time() - began)
                if found is None:
                    continue
                counts = (truth > 1e-12) & np.isfinite(found)
                scale = truth[counts] if phi is None else truth.max()
                error = np.abs(found[counts] - truth[counts]) / scale
                print(
                    f"| {' x '.join([str(n)] * axes)} | {name} | {peer} | {error.mean():.1e} "
                    f"| {error.max():.1e} | {spent:.0f} |"
                )


if __name__ == "__main__":
    main()
