# %% [markdown]
# # Training data: 10,000 touches
#
# The fingertip pad of the example projects is touched at 10,000 random places in random directions. The
# file `touches.npz` holds places, displacements, forces and what 25 markers on the skin see: data to learn
# a force estimator from.

# %%
import os
import pathlib
import time

import numpy as np
import palpa

folder = pathlib.Path(os.environ.get("PALPA_PROJECTS", "projects"))
project = palpa.open(folder / "fingertip-pad.json")
model = project.build(accuracy=0.03)
print(model)

# %% [markdown]
# Random places of the free surface: points of triangles, chosen by area, away from the support.

# %%
COUNT = 10_000
random = np.random.default_rng(1)
corners = model.nodes[model.triangles]
middle = corners.mean(axis=1)
lowest, highest = model.nodes[:, 2].min(), model.nodes[:, 2].max()
isfree = middle[:, 2] > lowest + 0.4 * (highest - lowest)
areas = np.linalg.norm(np.cross(*(corners[:, 1:] - corners[:, :1]).swapaxes(0, 1)), axis=1) / 2
chosen = random.choice(len(areas), COUNT, p=np.where(isfree, areas, 0) / areas[isfree].sum())
weights = random.dirichlet((1, 1, 1), COUNT)
at = np.einsum("nc,nci->ni", weights, corners[chosen])

# %% [markdown]
# Into the surface by 0.2 to 1 mm, within about 30° of the normal.

# %%
normals = np.cross(*(corners[chosen][:, 1:] - corners[chosen][:, :1]).swapaxes(0, 1))
normals /= np.linalg.norm(normals, axis=1, keepdims=True)
directions = -normals + 0.3 * random.normal(size=(COUNT, 3))
directions /= np.linalg.norm(directions, axis=1, keepdims=True)
displace = directions * random.uniform(0.2, 1.0, (COUNT, 1))

# The first batch computes the Green's functions; the second one shows the rate of one core.
model.touch_many(at, displace, radius=3)
start = time.process_time()
batch = model.touch_many(at, displace, radius=3)
seconds = time.process_time() - start
print(f"{COUNT / seconds:,.0f} touches per second of processor time")

# %%
skin = model.sensor(at[:25])
batch.save("touches.npz", markers_mm=skin.markers(batch))
with np.load("touches.npz") as file:
    for name in file:
        print(f"{name:20} {file[name].shape}")
print(f"forces from {np.linalg.norm(batch.forces, axis=1).min():.3f} N", end=" ")
print(f"to {np.linalg.norm(batch.forces, axis=1).max():.3f} N")
