# %% [markdown]
# # Stiffness against wall thickness
#
# A cap, a closed tube of silicone that stands on its rim, is pressed in the middle of its top. How does
# its stiffness depend on the thickness of the wall? A plate would become stiffer with the third power of
# its thickness.

# %%
import matplotlib.pyplot as plt
import numpy as np
import palpa

RADIUS, HEIGHT = 15.0, 18.0  # mm


def cap(thickness):
    """The cap with a wall thickness in mm, held at its rim."""
    inner, roof = RADIUS - thickness, HEIGHT - thickness
    corners = [[0, HEIGHT], [RADIUS, HEIGHT], [RADIUS, 0], [inner, 0], [inner, roof], [0, roof]]
    knots = [0, *range(len(corners)), len(corners) - 1]
    project = palpa.revolve({"degree": 1, "knots": knots, "points_mm": corners}, name="cap")
    project.material = "Ecoflex 00-30 silicone"
    project.supports = [palpa.Support("rim", palpa.below((0, 0, 1), 1.8))]
    return project


# %%
thicknesses = np.array([3.0, 4.0, 5.0, 6.0])
stiffness, errors = [], []
for thickness in thicknesses:
    project = cap(thickness)
    project.touches = [
        palpa.Touch("press the top", (0, 0, HEIGHT), displace=(0, 0, -0.5), radius=4)
    ]
    touch = project.build(edge_length=5).play()
    stiffness.append(touch.stiffness)
    errors.append(touch.error)
    print(f"{thickness:.1f} mm: {touch.stiffness:.4f} N/mm, to about {100 * touch.error:.1f} %")

# %% [markdown]
# The slope in the doubly logarithmic plot is the exponent. It is below 3, because thick walls also yield by
# shear and beneath the fingertip.

# %%
exponent = np.polyfit(np.log(thicknesses), np.log(stiffness), 1)[0]
print(f"stiffness grows with the power {exponent:.2f} of the thickness")

figure, axes = plt.subplots(figsize=(5, 3.5), layout="constrained")
axes.errorbar(thicknesses, stiffness, yerr=np.multiply(errors, stiffness), fmt="o-", capsize=4)
axes.set(xscale="log", yscale="log", xlabel="wall thickness (mm)", ylabel="stiffness (N/mm)")
axes.set_xticks(thicknesses, [f"{each:g}" for each in thicknesses])
axes.set_yticks(np.round(stiffness, 2), [f"{each:.2f}" for each in stiffness])
axes.minorticks_off()
axes.grid(True, alpha=0.3)
figure.savefig("stiffness_study.png", dpi=120)
