#!/usr/bin/python3
"""Writes a trace for `lockstep check --trace` (docs/traces.md): particles in free fall, stepped in float32 as the collision
pass steps those that meet nobody. Usage: write_trace.py FILE.h5   (Debian: python3-numpy, python3-h5py)"""
import hashlib
import json
import sys

import h5py
import numpy as np

f32 = np.float32
scene = {"constants": {"gravity": [0, -0.98, 0], "tick": 0.0166666675}, "image": [64, 48]}
gravity, tick = f32(scene["constants"]["gravity"]), f32(scene["constants"]["tick"])


def step(position, direction, speed, collide_time):
    v = direction * speed[:, None] + gravity * tick
    speed = np.sqrt((v[:, 0] * v[:, 0] + v[:, 1] * v[:, 1]) + v[:, 2] * v[:, 2])
    direction = v * (f32(1) / speed)[:, None]
    return position + (direction * speed[:, None]) * tick, direction, speed, collide_time - tick


x = np.linspace(-1, 1, 20, dtype=f32)
position, direction = np.stack([x, 0 * x, 0 * x], axis=1), np.tile(f32([0, 1, 0]), (20, 1))
states = [(position, direction, np.full(20, 0.5, f32), np.zeros(20, f32))]
for frame in range(60):
    states.append(step(*states[-1]))

with h5py.File(sys.argv[1], "w", userblock_size=512) as trace:
    trace.create_group("h5md").attrs["version"] = [1, 1]
    for name, values in zip(["position", "direction", "speed", "collide_time"], zip(*states)):
        trace[f"particles/all/{name}/value"] = np.stack(values)
    trace["parameters/lockstep/scene"] = json.dumps(scene)

with open(sys.argv[1], "r+b") as trace:
    content = trace.read()[512:]
    seal = f"lockstep trace 1\nbytes {512 + len(content)}\nsha256 {hashlib.sha256(content).hexdigest()}\n"
    trace.seek(0)
    trace.write(seal.encode().ljust(512, b"\0"))
