# %% [markdown]
# # Young's modulus from a force-depth table
#
# A pad of unknown silicone, 40 × 40 × 15 mm, was pressed with a ball of 8 mm radius. The table
# `indentation.csv` has depths and forces. Which Young's modulus explains them?
#
# (This table was computed with 0.17 MPa on a finer mesh and has 2 % noise added. Put your own measurement in its place.)

# %%
import pathlib

import matplotlib.pyplot as plt
import numpy as np
import palpa

folder = pathlib.Path(globals().get("__file__", "indentation.csv")).parent
table = np.genfromtxt(folder / "indentation.csv", delimiter=",", names=True)
depths, measured = table["depth_mm"], table["force_N"]

# %% [markdown]
# A model of the pad with any modulus, held below. The depth of a ball counts from first contact.

# %%
guess = 0.1  # MPa
project = palpa.box((40, 40, 15), name="pad")
project.material = palpa.Material(guess, 0.48, name="unknown silicone")
project.touches = [
    palpa.Touch("press", (0, 0, 15), displace=(0, 0, -depths[-1]), kind="ball", radius=8)
]
model = project.build(engine="quadratic")
sweep = model.sweep(12)
computed = np.interp(depths, sweep.shares * depths[-1], -sweep.forces[:, 0, 2])

# %% [markdown]
# Forces at given depths are proportional to the modulus, so the best fit is a quotient of two sums
# (least squares).

# %%
modulus = guess * (computed @ measured) / (computed @ computed)
residual = measured - modulus / guess * computed
noise = np.sqrt(residual @ residual / (len(depths) - 1))
uncertainty = modulus * np.hypot(
    noise / np.linalg.norm(modulus / guess * computed), model.play().error
)
print(f"Young's modulus: {modulus:.3f} ± {uncertainty:.3f} MPa")

# %%
figure, axes = plt.subplots(figsize=(5, 3.5), layout="constrained")
axes.plot(depths, measured, "o", label="measured")
axes.plot(depths, modulus / guess * computed, "-", label=f"Palpa, {modulus:.3f} MPa")
axes.set(xlabel="depth (mm)", ylabel="force (N)")
axes.legend()
figure.savefig("material_calibration.png", dpi=120)

# %% [markdown]
# The calibrated material goes into the project, ready for other shapes.

# %%
project.material = project.material.replace(youngs_modulus=round(float(modulus), 4))
project.save("pad.json")
print(project.material)
