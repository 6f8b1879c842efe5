"""The example clients against `palpa-cli serve`: `palpa-cli touch` gives the same forces.

Usage: device_clients_test.py PALPA_CLI PROJECTS EXAMPLES
"""

import json
import os
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import unittest

CLI, PROJECTS, EXAMPLES = sys.argv[1:4]
# Meshes that do not follow the touches, so that both commands have the same.
PROJECT = [os.path.join(PROJECTS, "sphere.json"), "--engine", "triangles", "--edge-length", "5"]
PATIENCE = 120  # s, on a busy machine


def run(arguments):
    return subprocess.run(arguments, capture_output=True, text=True, timeout=PATIENCE, check=False)


def exact(at, displace, kind, *options):
    done = run([CLI, "touch", *PROJECT, "--at", at, "--kind", kind, "--displace", displace, "--json",
                *options])
    if done.returncode != 0:
        raise AssertionError(done.stderr)
    return json.loads(done.stdout)["contacts"][0]["force_N"]


class Server:
    """palpa-cli serve in a temporary folder."""

    def __init__(self, *options):
        self.folder = tempfile.TemporaryDirectory()
        self.path = os.path.join(self.folder.name, "device.sock")
        self.process = subprocess.Popen(
            [CLI, "serve", *PROJECT, "--socket", self.path, *options], stdout=subprocess.PIPE,
            stderr=subprocess.PIPE, text=True)

    def __enter__(self):
        line = self.process.stdout.readline()
        if not line.startswith("listening"):
            raise AssertionError(line + self.process.stderr.read())
        return self

    def end(self):
        """The rest of the output, after Ctrl-C."""
        self.process.send_signal(signal.SIGINT)
        out, err = self.process.communicate(timeout=PATIENCE)
        return self.process.returncode, out + err

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.kill()
        self.process.communicate()
        self.folder.cleanup()


class Clients(unittest.TestCase):
    def assert_force(self, found, body, tolerance=2e-3):
        """The force on the user is opposite to the force on the body."""
        size = max(abs(part) for part in body)
        self.assertGreater(size, 0.1)
        for hand, part in zip(found["force_N"], body):
            self.assertAlmostEqual(hand, -part, delta=tolerance * size)
        self.assertTrue(found["touching"])
        self.assertGreater(found["stiffness_N_per_mm"], 0)

    def press_with_python(self, server, at, displace):
        done = run(["/usr/bin/python3", os.path.join(EXAMPLES, "press.py"), server.path,
                    "--at=" + at, "--displace=" + displace])
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def test_the_python_client_feels_the_force_of_touch(self):
        with Server("--radius", "8") as server:
            for at, displace in (("0,0,25", "0,0,-2"), ("0,0,25", "0,0,-1")):
                found = self.press_with_python(server, at, displace)
                self.assert_force(found, exact(at, displace, "push", "--radius", "8"))
                self.assertGreater(found["positions"], 1000)
            code, text = server.end()
        self.assertEqual(code, 0, text)
        self.assertIn("served     2 devices", text)
        self.assertIn("latency", text)
        self.assertFalse(os.path.exists(server.path))

    def test_a_ball_is_felt_too(self):
        with Server("--kind", "ball", "--radius", "6", "--once") as server:
            # The tool is the centre of the ball. Where it touches depends a little on its path.
            found = self.press_with_python(server, "0,0,31", "0,0,-2")
            self.assert_force(found, exact("0,0,25", "0,0,-2", "ball", "--radius", "6"), 0.01)
            out, err = server.process.communicate(timeout=PATIENCE)
        self.assertEqual(server.process.returncode, 0, err)
        self.assertIn("served     1 devices", out)

    def test_the_c_client_feels_the_force_of_touch(self):
        with Server("--radius", "8") as server:
            program = os.path.join(server.folder.name, "press")
            built = run(["cc", "-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-O2", "-o",
                         program, os.path.join(EXAMPLES, "press.c"), "-lm"])
            self.assertEqual(built.returncode, 0, built.stderr)
            done = run([program, server.path, "0", "0", "25", "0", "0", "-2"])
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assert_force(json.loads(done.stdout),
                              exact("0,0,25", "0,0,-2", "push", "--radius", "8"))
            # While somebody is connected, both clients say why they cannot be.
            with socket.socket(socket.AF_UNIX) as first:
                first.connect(server.path)
                first.sendall(struct.pack("<4sHHHH52x", b"PALP", 1, 64, 1, 1))
                first.recv(64)
                for client in ([program, server.path, "0", "0", "25", "0", "0", "-2"],
                               ["/usr/bin/python3", os.path.join(EXAMPLES, "press.py"), server.path,
                                "--at", "0,0,25", "--displace", "0,0,-2"]):
                    refused = run(client)
                    self.assertEqual(refused.returncode, 1)
                    self.assertIn("another device is connected to this Palpa; end it first",
                                  refused.stderr)

    def test_wrong_calls_have_their_exit_codes(self):
        for options, code, text in (
                (["--kind", "grab"], 2, "--kind: expected push or ball, found 'grab'"),
                (["--friction", "11"], 2, "--friction: expected a number from 0 to 10"),
                (["--socket", "/tmp/" + 120 * "x"], 3, "must have 1 to 107 bytes"),
                (["--socket", "/no/such/folder/socket"], 3, "cannot listen for a device here")):
            done = run([CLI, "serve", *PROJECT, *options])
            self.assertEqual(done.returncode, code, done.stderr)
            self.assertIn(text, done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
