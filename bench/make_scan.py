"""Writes a scanned organ as a binary STL file: a lobed ellipsoid with the noise of a scanner (docs/performance.md).

  make_scan.py FILE.stl [--triangles N] [--noise MM] [--seed N]
"""

import argparse
import math
import random
import struct

RADII = (95.0, 62.0, 38.0)  # mm
LOBES = 8


def directions(cells):
    """Vertices and triangles of a cube's six faces of cells x cells squares, projected on the unit sphere."""
    index, vertices, triangles = {}, [], []

    def vertex(*place):
        if place not in index:
            index[place] = len(vertices)
            # Equal angles, so that the squares are of nearly one size.
            x = [math.tan(math.pi / 4 * (2 * i / cells - 1)) for i in place]
            length = math.hypot(*x)
            vertices.append([c / length for c in x])
        return index[place]

    for axis in range(3):
        for side in (0, cells):
            for i in range(cells):
                for j in range(cells):
                    corners = []
                    for a, b in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)):
                        place = [0, 0, 0]
                        place[axis], place[(axis + 1) % 3], place[(axis + 2) % 3] = side, a, b
                        corners.append(vertex(*place))
                    if side == 0:
                        corners.reverse()  # normals point outwards
                    triangles += [(corners[0], corners[1], corners[2]), (corners[0], corners[2], corners[3])]
    return vertices, triangles


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file")
    parser.add_argument("--triangles", type=int, default=200_000, help="about so many (200000)")
    parser.add_argument("--noise", type=float, default=0.1, help="standard deviation along the normal, mm (0.1)")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    source = random.Random(arguments.seed)
    lobes = []
    for _ in range(LOBES):
        axis = [source.gauss(0, 1) for _ in range(3)]
        length = math.hypot(*axis)
        lobes.append(([c / length for c in axis], source.uniform(-0.12, 0.12), source.uniform(2, 5)))
    vertices, triangles = directions(max(2, round(math.sqrt(arguments.triangles / 12))))
    points = []
    for x in vertices:
        size = 1 + sum(height * math.exp(width * (sum(a * b for a, b in zip(x, axis)) - 1))
                       for axis, height, width in lobes)
        size += source.gauss(0, arguments.noise) / math.hypot(*(r * c for r, c in zip(RADII, x)))
        points.append([r * c * size for r, c in zip(RADII, x)])
    with open(arguments.file, "wb") as file:
        file.write(b"lobed ellipsoid".ljust(80) + struct.pack("<I", len(triangles)))
        for triangle in triangles:
            file.write(struct.pack("<12fH", 0, 0, 0, *(c for k in triangle for c in points[k]), 0))
    print(f"{arguments.file}: {len(triangles)} triangles")


if __name__ == "__main__":
    main()
