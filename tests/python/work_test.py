"""Long work: other threads go on, progress is reported, Ctrl-C and callbacks stop it."""

import signal
import subprocess
import sys
import threading
import time

import palpa
import pytest


def long_project():
    """Some seconds of assembly and factorisation."""
    project = palpa.sphere(25)
    project.mesh = project.mesh.replace(edge_length=1.6, engine="triangles")
    return project


def test_other_threads_run_during_a_build():
    counted, ended = 0, threading.Event()

    def count():
        nonlocal counted
        while not ended.is_set():
            counted += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    before = None

    def progress(phase, fraction):
        # Both calls come from inside of the build.
        nonlocal before
        if before is None:
            thread.start()
            before = 0
        elif counted > 20:
            return False
        return True

    with pytest.raises(palpa.Cancelled):
        long_project().build(progress=progress)
    ended.set()
    thread.join()
    assert counted > 20


def test_progress_names_the_phases_in_order():
    seen = []
    palpa.sphere(25).build(edge_length=6, progress=lambda phase, fraction: seen.append((phase, fraction)))
    phases = list(dict.fromkeys(phase for phase, _ in seen))
    assert phases == ["mesh", "check", "setup", "assemble", "factorise", "solve"]
    for name in phases:
        fractions = [fraction for phase, fraction in seen if phase == name]
        assert fractions == sorted(fractions) and 0 <= fractions[0] and fractions[-1] == 1


def test_a_callback_stops_the_work():
    with pytest.raises(palpa.Cancelled):
        long_project().build(progress=lambda phase, fraction: phase != "assemble")


def test_an_exception_of_a_callback_stops_the_work():
    def progress(phase, fraction):
        raise LookupError(phase)

    with pytest.raises(LookupError, match="mesh"):
        long_project().build(progress=progress)


def test_ctrl_c_stops_the_work():
    program = """
import os, signal, threading
import palpa
project = palpa.sphere(25)
project.mesh = project.mesh.replace(edge_length=1.2, engine="triangles")
def progress(phase, fraction):
    if phase == "assemble" and fraction > 0:
        os.kill(os.getpid(), signal.SIGINT)
try:
    project.build(progress=progress)
except KeyboardInterrupt:
    print("interrupted")
# The interpreter is whole.
print(palpa.sphere(25).build(edge_length=8).report["engine"])
"""
    outcome = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert outcome.returncode == 0, outcome.stderr
    assert outcome.stdout.split() == ["interrupted", "quadratic"]


def test_handlers_of_signals_run_during_the_work():
    class Alarm(Exception):
        pass

    def handle(number, frame):
        raise Alarm

    former = signal.signal(signal.SIGALRM, handle)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.2)
        with pytest.raises(Alarm):
            long_project().build()
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, former)


def test_several_threads_touch_one_model(ball):
    expected = ball.touch((0, 0, 25), (0, 0, -1), radius=6).force
    found = []

    def touch():
        for _ in range(5):
            found.append(ball.touch((0, 0, 25), (0, 0, -1), radius=6).force)

    threads = [threading.Thread(target=touch) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(found) == 20 and all((force == expected).all() for force in found)
