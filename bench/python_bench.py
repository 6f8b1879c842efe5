"""Times of the Python package: import, batches of touches, cancelling, other threads during a build.

PYTHONPATH=build/release/python python3 bench/python_bench.py [--repeat N]

Prints the best and the median of N runs; their difference shows the noise of the machine.
"""

import argparse
import os
import signal
import statistics
import subprocess
import sys
import threading
import time

import numpy as np
import palpa


def report(what, unit, goal, values):
    best = min(values) if goal.startswith("<") else max(values)
    print(f"{what:44} best {best:10.4g}  median {statistics.median(values):10.4g} {unit:10} goal {goal}")


def import_seconds():
    program = "import time; start = time.perf_counter(); import palpa; print(time.perf_counter() - start)"
    return float(subprocess.run([sys.executable, "-c", program], capture_output=True, check=True).stdout)


def touch_rates(model, at, displace):
    """Touches per second, and per second of processor time: what one core does when nothing else runs."""
    start, used = time.perf_counter(), time.process_time()
    model.touch_many(at, displace, radius=6)
    return len(at) / (time.perf_counter() - start), len(at) / (time.process_time() - used)


def cancel_seconds(project):
    """From SIGINT, in the middle of the assembly, to KeyboardInterrupt."""
    sent = []

    def interrupt():
        time.sleep(1.0)
        sent.append(time.perf_counter())
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=interrupt)
    thread.start()
    try:
        project.build(engine="triangles", edge_length=1.4)
    except KeyboardInterrupt:
        return time.perf_counter() - sent[0]
    finally:
        thread.join()
    raise SystemExit("the build was not interrupted")


def longest_pause(project):
    """The longest pause of a thread that wants to run every millisecond, during a build."""
    ended, pauses = threading.Event(), []

    def beat():
        last = time.perf_counter()
        while not ended.is_set():
            time.sleep(0.001)
            now = time.perf_counter()
            pauses.append(now - last)
            last = now

    thread = threading.Thread(target=beat)
    thread.start()
    project.build(edge_length=3)
    ended.set()
    thread.join()
    return max(pauses)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--repeat", type=int, default=5)
    repeat = parser.parse_args().repeat
    print(f"{os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}")

    project = palpa.sphere(25)
    model = project.build(edge_length=2.8)
    random = np.random.default_rng(0)
    normals = random.normal(size=(20_000, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    normals = normals[normals[:, 2] > -0.5][:10_000]
    model.touch_many(25 * normals, -normals, radius=6)  # computes the Green's functions

    coefficients = model.report["coefficients"]
    report("import", "s", "<= 0.3", [import_seconds() for _ in range(repeat)])
    rates, rates_per_core = zip(*[touch_rates(model, 25 * normals, -normals) for _ in range(repeat)])
    report(f"touches, {coefficients} coefficients", "1/s", ">= 10000", rates)
    report("touches per second of processor time", "1/s", ">= 5000", rates_per_core)
    report("Ctrl-C to KeyboardInterrupt", "s", "<= 0.1", [cancel_seconds(project) for _ in range(repeat)])
    report("longest pause of a thread during a build", "s", "<= 0.1", [longest_pause(project) for _ in range(repeat)])


if __name__ == "__main__":
    main()
