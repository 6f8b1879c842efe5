"""palpa-mpi on one machine: forces with 1, 2 and 4 ranks, errors, and the end of all ranks."""

import json
import os
import pathlib
import signal
import subprocess
import tempfile
import time
import unittest

MPI = os.environ["PALPA_MPI"]
CLI = os.environ["PALPA_CLI"]
MPIRUN = os.environ["PALPA_MPIRUN"]
ROOT = pathlib.Path(os.environ["PALPA_ROOT"])
ENVIRONMENT = dict(
    os.environ,
    # More ranks than cores, and containers whose user is root.
    OMPI_MCA_rmaps_base_oversubscribe="1",
    OMPI_ALLOW_RUN_AS_ROOT="1",
    OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
)


def forces(report):
    return [entry["force_N"] for entry in report["supports"] + report["contacts"]]


def difference(a, b):
    """Largest difference of two lists of vectors over the largest component."""
    largest = max(abs(x) for vector in b for x in vector)
    return max(abs(x - y) for v, w in zip(a, b, strict=True) for x, y in zip(v, w)) / largest


class Ranks(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="palpa-mpi-")
        self.work = pathlib.Path(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def project(self, name, edge_length, engine="quadratic"):
        project = json.loads((ROOT / "projects" / name).read_text())
        project["mesh"] = {"edge_length_mm": edge_length, "engine": engine}
        file = self.work / name
        file.write_text(json.dumps(project))
        return file

    def start(self, ranks, project, *options):
        return subprocess.Popen(
            [MPIRUN, "-n", str(ranks), MPI, str(project), *map(str, options)],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env=ENVIRONMENT,
        )

    def run_ranks(self, ranks, project, *options):
        process = self.start(ranks, project, *options)
        out, err = process.communicate(timeout=300)
        return process.returncode, out, err

    def touch(self, *arguments):
        run = subprocess.run(
            [CLI, "touch", *map(str, arguments), "--json"], capture_output=True, text=True, timeout=300
        )
        return run.returncode, json.loads(run.stdout), run.stderr

    def test_any_number_of_ranks_gives_the_same_forces(self):
        # On the slender finger the rounding of single precision moves forces further than on the box.
        for name, edge_length, limit in (("box.json", 5, 1e-6), ("gripper-finger.json", 4, 2e-5)):
            project = self.project(name, edge_length)
            code, alone, _ = self.touch(project)
            self.assertEqual(code, 0)
            stored = []
            for ranks in (1, 2, 4):
                model = self.work / f"{ranks}.model"
                code, out, err = self.run_ranks(ranks, project, "-o", model, "--json", "--columns", 40)
                self.assertEqual(code, 0, err)
                report = json.loads(out)
                self.assertEqual(report["ranks"], ranks)
                self.assertGreaterEqual(report["columns"], 120)
                code, touched, err = self.touch(project, "--model", model)
                self.assertEqual(code, 0, err)
                self.assertEqual(touched["seconds"]["assemble"], 0)
                self.assertEqual(touched["operators"]["storage"], "compressed")
                # What the ranks found together, and what one process finds with their model.
                self.assertLess(difference(forces(report), forces(touched)), 2e-5)
                self.assertLess(
                    difference(forces(touched), forces(alone)), alone["force_error_estimate"]
                )
                stored.append((forces(report), forces(touched)))
            for of_ranks, of_model in stored[1:]:
                self.assertLess(difference(of_ranks, stored[0][0]), limit)
                self.assertLess(difference(of_model, stored[0][1]), limit)

    def test_a_model_belongs_to_its_project(self):
        project, model = self.project("box.json", 8), self.work / "box.model"
        code, _, err = self.run_ranks(2, project, "-o", model, "-q")
        self.assertEqual((code, err), (0, ""))
        code, report, err = self.touch(project, "--model", model, "--edge-length", 4)
        self.assertEqual(code, 3)
        self.assertIn("was computed for another mesh", err)
        self.assertEqual(self.touch(project, "--model", self.work / "none.model")[0], 3)
        with open(model, "r+b") as file:
            file.seek(5000)
            byte = file.read(1)[0]
            file.seek(5000)
            file.write(bytes([byte ^ 1]))
        code, report, err = self.touch(project, "--model", model)
        self.assertEqual(code, 3)
        self.assertIn("is not a complete stored model", err)

    def test_an_error_ends_all_ranks_with_one_message(self):
        code, out, err = self.run_ranks(2, self.project("box.json", 8, "splines"), "-o", "x.model")
        self.assertEqual((code, out), (3, ""))
        self.assertEqual(err.count("is not computed with curved triangles"), 1)
        code, _, err = self.run_ranks(2, self.project("box.json", 8), "-o", "/nowhere/x.model", "-q")
        self.assertEqual(code, 3)
        self.assertEqual(err.count("/nowhere/x.model"), 1)
        code, _, err = self.run_ranks(2, "box.json", "--tolerance", 1)
        self.assertEqual(code, 2)
        self.assertEqual(err.count("palpa-mpi --help"), 1)

    def assembling(self, ranks):
        """A run of some minutes in its second phase of computation, and its ranks."""
        process = self.start(ranks, self.project("box.json", 1.2), "-o", self.work / "box.model")
        for line in process.stderr:
            if "assemble" in line:
                break
        children = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text()
        members = [int(pid) for pid in children.split()]
        self.assertEqual(len(members), ranks)
        return process, members

    @staticmethod
    def is_running(pid):
        try:
            state = pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
        except (FileNotFoundError, ProcessLookupError):
            return False
        return state not in "ZX"

    def assert_ends(self, process, members):
        _, err = process.communicate(timeout=30)
        self.assertNotEqual(process.returncode, 0)
        # mpirun may end a moment before the ranks that it has killed.
        end = time.monotonic() + 20
        while any(map(self.is_running, members)):
            self.assertLess(time.monotonic(), end, "a rank is left")
            time.sleep(0.1)
        self.assertEqual([file.suffix for file in self.work.iterdir()], [".json"])
        return err

    def test_killing_a_rank_ends_the_others(self):
        process, members = self.assembling(3)
        os.kill(members[1], signal.SIGKILL)
        self.assertIn("signal 9", self.assert_ends(process, members))

    def test_an_interrupt_ends_all_ranks(self):
        process, members = self.assembling(2)
        time.sleep(0.3)
        process.send_signal(signal.SIGINT)
        self.assert_ends(process, members)


if __name__ == "__main__":
    unittest.main()
