"""Exported pages in Chromium beside palpa-cli: forces at random places, and frames.

python3 bench/page_bench.py CLI FILE... [--touches 200] [--frames 100] [--seed 1]

CLI: the program palpa-cli; FILE: projects, CAD or mesh files. Every touch grabs a random place of the
drawn surface and moves it by a tenth of its radius inwards and aside. Prints, per file, the size of the page, the
relative difference from palpa-cli over what the page states (the sum, and its own part alone), and the
time of a frame with one touch: solved, deformed, drawn in software and read back.
"""

import argparse
import json
import pathlib
import random
import statistics
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "tests/app/page"))
from browser import Browser  # noqa: E402  (a folder of this project)

# Places within the drawn triangles that can be touched, by area, and outward normals there.
PLACES = """((count, seed) => {
  const model = page.model, areas = [];
  let total = 0;
  const corner = (t, k) => model.row(model.positions, model.triangles[3 * t + k]);
  for (let t = 0; t < model.triangleCount; ++t) {
    const a = corner(t, 0), e = subtract(corner(t, 1), a), f = subtract(corner(t, 2), a);
    total += model.touchable[t] ? lengthOf(cross(e, f)) : 0;
    areas.push(total);
  }
  const random = () => (seed = (16807 * seed) % 2147483647) / 2147483647;
  const list = [];
  for (let k = 0; k < count; ++k) {
    const wanted = random() * total, t = areas.findIndex((sum) => sum >= wanted);
    const r = Math.sqrt(random()), s = random();
    const point = model.prepare({triangle: t, weights: [1 - r, r * (1 - s), r * s]});
    list.push([point.position, point.normal]);
  }
  return {radius: model.radius, list};
})"""
FORCES = """((touches) => touches.map(({at, displacement}) => {
  const touch = {point: page.model.prepare(page.model.nearest(at)), displacement};
  page.model.solve([touch]);
  return [touch.force, touch.error, touch.pageError];
}))"""
FRAMES = """((count) => {
  const out = document.getElementById("selftest");
  if (out) out.remove();
  selfTest(page, JSON.stringify({touches: [], frames: count}));
  return JSON.parse(document.getElementById("selftest").textContent);
})"""


def run(*command):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stderr}")
    return json.loads(done.stdout)


def texts(vector):
    return ",".join(repr(float(x)) for x in vector)


def length(vector):
    return sum(x * x for x in vector) ** 0.5


def measure(options, file, folder):
    page_file = folder / "page.html"
    made = run(options.cli, "export", file, "-o", page_file, "--json")
    with Browser(page_file, 1280, 800) as page:
        places = page.evaluate(f"{PLACES}({options.touches}, {options.seed})")
        radius, generator = places["radius"], random.Random(options.seed)
        touches = [{"at": at, "displacement": [0.1 * radius * (generator.uniform(-0.5, 0.5) - n) for n in normal]}
                   for at, normal in places["list"]]
        stated = page.evaluate(f"{FORCES}({json.dumps(touches)})")
        frames = page.evaluate(f"{FRAMES}({options.frames})")
    sums, parts, differences = [], [], []
    for touch, (force, error, own) in zip(touches, stated):
        report = run(options.cli, "touch", file, "--at", texts(touch["at"]), "--displace", texts(touch["displacement"]),
                     "--radius", radius, "--json")
        exact = report["contacts"][0]["force_N"]
        difference = length([a - b for a, b in zip(force, exact)])
        differences.append(difference / length(exact))
        sums.append(difference / error)
        parts.append(difference / own)
    print(f"{file}: {page_file.stat().st_size / 1e6:.1f} MB, {made['page']['places']} places, radius {radius:.3g} mm")
    print(f"  {len(sums)} touches: differ by {100 * statistics.median(differences):.2g} % in the median, "
          f"{100 * max(differences):.2g} % at worst; over the stated error {statistics.median(sums):.2g} and {max(sums):.2g}; "
          f"{sum(x > 1 for x in sums)} above it, {sum(x > 1 for x in parts)} above the part of the page")
    print(f"  a frame of {frames['canvas'][0]} x {frames['canvas'][1]} pixels: {frames['frame_ms']:.3g} ms "
          f"({1000 / frames['frame_ms']:.0f} per second)", flush=True)


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("cli")
    options.add_argument("files", nargs="+")
    options.add_argument("--touches", type=int, default=200)
    options.add_argument("--frames", type=int, default=100)
    options.add_argument("--seed", type=int, default=1)
    options = options.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        for file in options.files:
            measure(options, file, pathlib.Path(folder))


main()
