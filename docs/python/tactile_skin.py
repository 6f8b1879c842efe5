# %% [markdown]
# # A tactile sensor: gel with markers
#
# A gel, 30 × 30 × 8 mm, is glued to a rigid base. A camera sees markers on its top; pressure sensors
# (taxels) lie below it. What do they read when a ball presses and drags?

# %%
import matplotlib.pyplot as plt
import numpy as np
import palpa

project = palpa.box((30, 30, 8), name="gel")
project.material = palpa.Material(0.12, 0.48, name="gel")
model = project.build(accuracy=0.03)
print(model)


def grid(count, extent, z):
    """count × count places on a square at the height z, mm."""
    line = np.linspace(-extent, extent, count)
    x, y = np.meshgrid(line, line)
    return np.column_stack([x.ravel(), y.ravel(), np.full(count * count, z)])


markers = model.sensor(grid(9, 12, 8))
taxels = model.sensor(grid(7, 12, 0))

# %% [markdown]
# A ball of 5 mm radius presses 1 mm deep and drags by 0.6 mm, with friction.

# %%
at = np.array([4.0, -2.0, 8.0])
touch = model.touch(at, (0.6, 0, -1.0), kind="ball", radius=5, friction=0.8)
moved = markers.markers(touch)
pressures = taxels.pressures(touch)
contact = touch.contacts[0]
print(f"force {np.round(contact.force, 3)} N, {contact.status}")
print(f"markers move by up to {np.linalg.norm(moved, axis=1).max():.3f} mm")
print(f"taxels read up to {1000 * pressures.max():.1f} kPa")

# %% [markdown]
# Where was it touched? The centroid of the positive pressures below the gel says so.

# %%
weights = np.clip(pressures, 0, None)
found = weights @ taxels.at[:, :2] / weights.sum()
print(f"touched at {at[:2]}, pressures point to {np.round(found, 1)}")

# %%
figure, (left, right) = plt.subplots(1, 2, figsize=(8, 3.8), layout="constrained")
left.quiver(*markers.at[:, :2].T, *moved[:, :2].T, angles="xy", scale_units="xy", scale=0.25)
left.plot(*at[:2], "r+", markersize=12)
left.set(title="markers on top (motion × 4)", xlabel="x (mm)", ylabel="y (mm)", aspect="equal")
image = right.imshow(
    1000 * pressures.reshape(7, 7), origin="lower", extent=(-14, 14, -14, 14), interpolation="nearest"
)
right.plot(*at[:2], "r+", markersize=12)
right.set(title="taxels below", xlabel="x (mm)", ylabel="y (mm)")
figure.colorbar(image, ax=right, label="pressure (kPa)")
figure.savefig("tactile_skin.png", dpi=120)
