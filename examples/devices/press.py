#!/usr/bin/env python3
"""A device for Palpa without hardware: presses into the body and prints the force.

    palpa-cli serve projects/sphere.json --socket /tmp/palpa.sock &
    python3 press.py /tmp/palpa.sock --at 0,0,25 --displace 0,0,-2

Moves a handle from outside of the body to the place, on along the displacement at 20 mm/s, rests
there, and goes back. Replace `position` by the encoders of your device and apply each force to its
motors. The protocol is described in docs/device-protocol.md. Needs nothing but Python 3.
"""

import argparse
import json
import math
import socket
import struct
import sys
import time

PERIOD = 1e-3  # s
SPEED = 20.0  # mm/s
HELLO, WELCOME, POSITION, FORCE, ERROR = 1, 2, 3, 4, 5
TOUCHING = 1  # bit of the status


def vector(text):
    numbers = [float(part) for part in text.split(",")]
    if len(numbers) != 3:
        raise argparse.ArgumentTypeError("expected x,y,z")
    return numbers


def receive(connection):
    """The next message, without its head: type and bytes. Exits with the text of an error."""
    data = b""
    size = 8
    while len(data) < size:
        part = connection.recv(size - len(data))
        if not part:
            sys.exit("press.py: Palpa closed the connection")
        data += part
        if len(data) == 8:
            magic, kind, size = struct.unpack("<4sHH", data)
            if magic != b"PALP":
                sys.exit("press.py: this is not Palpa")
    if kind == ERROR:
        text = data[16:].split(b"\0", 1)[0].decode("utf-8", "replace")
        sys.exit(f"press.py: {text}")
    return kind, data[8:]


def send(connection, message):
    try:
        connection.sendall(message)
    except BrokenPipeError:
        pass  # the reason can still be read


def greet(connection, version=1):
    # No workspace: positions are in the coordinates of the project. This device is a program that
    # renders any stiffness and any force.
    send(connection, struct.pack("<4sHHHH4x3ddd8x", b"PALP", HELLO, 64, version, version,
                                 0.0, 0.0, 0.0, 0.0, 1e6))
    kind, data = receive(connection)
    if kind != WELCOME:
        sys.exit("press.py: expected a welcome")
    return struct.unpack("<H2xI3ddd8x", data)


def ask(connection, sequence, position, buttons=0):
    """Sends a position in mm; returns force in N, status, stiffness in N/mm, age in ms."""
    send(connection, struct.pack("<4sHHQ3dI4xd8x", b"PALP", POSITION, 64, sequence, *position,
                                 buttons, time.monotonic()))
    kind, data = receive(connection)
    answered, fx, fy, fz, status, _model, stiffness, age = struct.unpack("<Q3dIIdd", data)
    if kind != FORCE or answered != sequence:
        sys.exit("press.py: expected a force")
    return (fx, fy, fz), status, stiffness, age


def main():
    parser = argparse.ArgumentParser(description="Press into the body that Palpa serves.")
    parser.add_argument("socket", help="path of the socket")
    parser.add_argument("--at", type=vector, required=True, help="place on the body, x,y,z in mm")
    parser.add_argument("--displace", type=vector, required=True,
                        help="displacement of the tool into the body, x,y,z in mm")
    parser.add_argument("--rest", type=float, default=1.0, help="time at the deepest place, s")
    options = parser.parse_args()
    depth = math.dist((0, 0, 0), options.displace)
    if depth == 0:
        parser.error("--displace must not be zero")
    direction = [part / depth for part in options.displace]

    connection = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    try:
        connection.connect(options.socket)
    except OSError as error:
        sys.exit(f"press.py: {options.socket}: {error.strerror}")
    greet(connection)

    sequence = 0
    round_trips = []
    due = time.monotonic()

    def move_to(distance):
        """One millisecond at a distance along the direction, mm from the place; positive inside."""
        nonlocal sequence, due
        sequence += 1
        position = [at + distance * part for at, part in zip(options.at, direction)]
        sent = time.monotonic()
        answer = ask(connection, sequence, position)
        round_trips.append(time.monotonic() - sent)
        due += PERIOD
        time.sleep(max(0.0, due - time.monotonic()))
        return answer

    # Wait in front of the body until the place is computed: then the stiffness is known.
    while move_to(-1.0)[2] == 0:
        pass
    distance = -1.0
    while distance < depth:
        distance = min(depth, distance + SPEED * PERIOD)
        move_to(distance)
    for _ in range(max(1, int(options.rest / PERIOD))):
        force, status, stiffness, age = move_to(depth)
    while distance > -1.0:
        distance -= SPEED * PERIOD
        move_to(distance)

    round_trips.sort()
    print(json.dumps({
        "force_N": force,
        "touching": bool(status & TOUCHING),
        "stiffness_N_per_mm": stiffness,
        "positions": sequence,
        "round_trip_ms": {"p50": 1e3 * round_trips[len(round_trips) // 2],
                          "p99": 1e3 * round_trips[len(round_trips) * 99 // 100]},
    }))


if __name__ == "__main__":
    main()
