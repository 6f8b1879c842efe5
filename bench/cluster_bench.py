"""Times palpa-mpi with several ranks on this machine, and predicts larger bodies on more ranks (docs/cluster.md).

  cluster_bench.py measure [--bin FOLDER] [--edges MM …] [--ranks N …] [--rounds N] [--table FILE]
  cluster_bench.py predict [--table FILE]

`measure` takes a sphere with one touch and writes a line per run; `predict` prints the table of the page from these lines.
Work is the processor time of the rank that works longest, without waiting for others: other programs hardly change it.
"""

import argparse
import csv
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PHASES = ["assemble", "factorise", "columns"]
FIELDS = ["nodes", "unknowns", "ranks", *PHASES, *(phase + "_work" for phase in PHASES), "column_count", "operators",
          "factors", "peak", "load"]


def measure(arguments):
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                       OMPI_MCA_rmaps_base_oversubscribe="1")
    with open(arguments.table, "a", newline="") as table, tempfile.TemporaryDirectory() as work:
        writer = csv.DictWriter(table, FIELDS)
        if table.tell() == 0:
            writer.writeheader()
        project = json.loads((ROOT / "projects" / "sphere.json").read_text())
        file, model = pathlib.Path(work) / "sphere.json", pathlib.Path(work) / "sphere.model"
        for edge in arguments.edges:
            project["mesh"] = {"edge_length_mm": edge, "engine": "quadratic"}
            file.write_text(json.dumps(project))
            for _ in range(arguments.rounds):
                for ranks in arguments.ranks:
                    load = os.getloadavg()[0]
                    run = subprocess.run(
                        ["mpirun", "-n", str(ranks), str(arguments.bin / "palpa-mpi"), str(file), "-o", str(model),
                         "--json", "--columns", "320"],
                        env=environment, capture_output=True, text=True)
                    if run.returncode != 0:
                        sys.exit(run.stderr)
                    report = json.loads(run.stdout)
                    seconds, memory = report["seconds"], report["memory_bytes"]
                    writer.writerow({
                        "nodes": report["nodes"], "unknowns": report["unknowns"], "ranks": ranks,
                        "assemble": seconds["assemble"], "factorise": seconds["factorise"],
                        "columns": seconds["columns"], "column_count": report["columns"],
                        **{phase + "_work": report["work_seconds"][phase] for phase in PHASES},
                        "operators": memory["operators"], "factors": memory["factors"],
                        "peak": max(memory["peaks"]), "load": load})
                    table.flush()


def read(file):
    with open(file, newline="") as table:
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(table)]


def best(rows, nodes, ranks, key):
    values = [row[key] for row in rows if row["nodes"] == nodes and row["ranks"] == ranks]
    return min(values) if values else None


def efficiencies(rows):
    print("| nodes | ranks | assembly, s | factors, s | columns, ms each | efficiency: assembly | factors | columns |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    for nodes, ranks in sorted({(row["nodes"], row["ranks"]) for row in rows}):
        line = []
        for key in (phase + "_work" for phase in PHASES):
            one, some = best(rows, nodes, 1, key), best(rows, nodes, ranks, key)
            line.append((some, one / (ranks * some) if one else math.nan))
        count = best(rows, nodes, ranks, "column_count")
        print(f"| {nodes:.0f} | {ranks:.0f} | {line[0][0]:.1f} | {line[1][0]:.1f} | {1e3 * line[2][0] / count:.1f} | " +
              " | ".join(f"{efficiency:.2f}" for _, efficiency in line) + " |")


class Model:
    """Rates of one rank of this machine, and the parts that more ranks do not divide."""

    REPEATED_CHOICES = 0.15  # of the assembly: rows chosen again by ranks that share a cluster, beyond 8 ranks
    BANDWIDTH = 1.2e9  # bytes/s that a rank receives: assumed, a tenth of a link of 100 Gbit/s
    STEPS = 6  # of GMRES

    def __init__(self, rows):
        nodes = sorted({row["nodes"] for row in rows})
        small, large = nodes[0], nodes[-1]
        unknowns = best(rows, large, 1, "unknowns")
        self.per_node = unknowns / large

        def rate(key, size):
            return best(rows, large, 1, key + "_work") / size(large)

        self.assembly = rate("assemble", lambda n: n * math.log2(n))
        self.factors = rate("factorise", lambda n: n**2)
        self.column = rate("columns", lambda n: n * math.log2(n)) / best(rows, large, 1, "column_count")
        self.divided = {}
        for key in ("assemble", "factorise"):
            # T(2) = T(1) (share + (1 - share) / 2)
            share = 2 * best(rows, large, 2, key + "_work") / best(rows, large, 1, key + "_work") - 1
            self.divided[key] = 1 - min(max(share, 0.0), 1.0)
        # Bytes per node grow with the logarithm (operators) or with n (factors).
        self.operator_bytes = self.line([(math.log2(n), best(rows, n, 1, "operators") / n) for n in (small, large)])
        self.factor_bytes = self.line([(n, best(rows, n, 1, "factors") / n) for n in (small, large)])

    @staticmethod
    def line(points):
        (x, a), (y, b) = points
        slope = (b - a) / (y - x) if y > x else 0.0
        return lambda z: a + slope * (z - x)

    def predict(self, unknowns, ranks):
        n = unknowns / self.per_node
        tree = n * math.log2(n)
        assembly = self.assembly * tree * (
            1 - self.divided["assemble"] + self.divided["assemble"] / ranks +
            self.REPEATED_CHOICES * max(0.0, 1 / 8 - 1 / ranks))
        factor_bytes = self.factor_bytes(n) * n
        others = 1 - 1 / ranks
        factors = self.factors * n**2 * (1 - self.divided["factorise"] + self.divided["factorise"] / ranks)
        factors += (4 * unknowns**2 / ranks + factor_bytes) * others / self.BANDWIDTH
        column = self.column * tree / ranks + self.STEPS * 2 * 8 * unknowns * others / self.BANDWIDTH
        columns_at_once = 96 * unknowns * 8
        operators = self.operator_bytes(math.log2(n)) * n / ranks
        memory = operators + factor_bytes + columns_at_once * (4 + 2 * self.STEPS / ranks)
        return assembly, factors, column, operators, memory


def predict(rows):
    model = Model(rows)
    print("| unknowns | ranks | assembly | factors | 1,000 columns | operators per rank | memory per rank |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for unknowns in (2e5, 1e6, 5e6):
        for ranks in (4, 16, 64, 256):
            assembly, factors, column, operators, memory = model.predict(unknowns, ranks)
            print(f"| {unknowns / 1e6:g} million | {ranks} | {minutes(assembly)} | {minutes(factors)} | "
                  f"{minutes(1000 * column)} | {operators / 2**30:.2g} GiB | {gibibytes(memory)} |")


def minutes(seconds):
    if seconds < 120:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 7200 else f"{seconds / 3600:.0f} h"


def gibibytes(size):
    text = f"{size / 2**30:.0f}" if size > 20 * 2**30 else f"{size / 2**30:.2g}"
    return text + " GiB"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["measure", "predict"])
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/release/bin")
    parser.add_argument("--edges", type=float, nargs="+", default=[1.7, 1.0])
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--rounds", type=int, default=2)
    parser.add_argument("--table", default="cluster.csv")
    arguments = parser.parse_args()
    if arguments.what == "measure":
        measure(arguments)
    rows = read(arguments.table)
    if len({row["nodes"] for row in rows}) < 2 or not {1, 2} <= {row["ranks"] for row in rows}:
        sys.exit("a prediction needs measurements of two sizes with 1 and 2 ranks: cluster_bench.py measure")
    efficiencies(rows)
    print()
    predict(rows)


if __name__ == "__main__":
    main()
