"""A robot in space-time: a plane and the time, and a door that opens late."""

# %% Space-time in simplices: 2 axes of space, 1 of time; a wall at x = 0.5 stands until t = 0.5.
import itertools

import numpy as np

import plexway

n = 8
steps = np.array(list(itertools.product(range(n + 1), repeat=3)))
number = {tuple(s): i for i, s in enumerate(steps.tolist())}
simplices = []
for cell in itertools.product(range(n), repeat=3):
    for order in itertools.permutations(range(3)):
        at, corners = list(cell), [number[cell]]
        for axis in order:
            at[axis] += 1
            corners.append(number[tuple(at)])
        simplices.append(corners)
simplices = np.array(simplices)
V = steps / n
centre = V[simplices].mean(axis=1)
wall = (np.abs(centre[:, 0] - 0.4375) < 1 / n / 2) & (centre[:, 2] < 0.5)

# %% Without the wall the way is straight.
free = plexway.Simplicial(V, simplices, precision="double")
print(free)
start, goal = number[0, 4, 0], number[n, 4, n]
straight = free.distance(start)
assert abs(straight[goal] - np.linalg.norm(V[goal] - V[start])) < 1e-9

# %% With it the robot waits: the way bends over the edge of the wall, at x = 0.375, t = 0.5.
world = plexway.Simplicial(V, simplices[~wall], precision="double")
waits = world.distance(start)
bend = np.array([0.375, 0.5, 0.5])
print(f"straight {straight[goal]:.4f}, with the wall {waits[goal]:.4f}")
truth = np.linalg.norm(bend - V[start]) + np.linalg.norm(V[goal] - bend)
assert straight[goal] - 1e-9 <= waits[goal]
assert abs(waits[goal] - truth) < 1e-6
