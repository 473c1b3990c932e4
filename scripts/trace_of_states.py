#!/usr/bin/python3
"""Makes a trace of the states that the report page's live view saved, so that `lockstep check --trace` can judge them.

Usage: scripts/trace_of_states.py STATES.gz TRACE.h5 [PROFILE.json]

PROFILE.json says how the browser's driver rounds (docs/traces.md); without it GLSL's rules alone judge. Needs numpy and
h5py (Debian: python3-h5py).
"""
import gzip
import hashlib
import json
import os
import sys

import h5py
import numpy as np

SEAL = 512  # bytes, docs/traces.md

# Of states saved before their first line told it: name, components and offset in a particle's record of words.
FIELDS = [
    {"name": "position", "components": 3, "offset": 0},
    {"name": "speed", "components": 1, "offset": 3},
    {"name": "direction", "components": 3, "offset": 4},
    {"name": "collide_time", "components": 1, "offset": 7},
]


def read(stream, type, *shape):
    size = int(np.prod(shape)) * np.dtype(type).itemsize
    data = stream.read(size)
    if len(data) < size:
        raise ValueError("cut off")
    return np.frombuffer(data, type).reshape(shape)


def write(states, path, profile):
    head = json.loads(states.readline())
    if head.get("lockstep") != "states 1":
        raise ValueError("not states that a report page saved")
    n, frames, width, height = (head[key] for key in ("particles", "frames", "width", "height"))
    record = head.get("record", {"words": 8, "fields": FIELDS})
    rows = np.empty((frames + 1, n, record["words"]), "<f4")
    rows[0] = read(states, "<f4", n, record["words"])
    corners = read(states, "<f4", head["corners"], 3)
    triangles = read(states, "<u4", head["triangles"], 3)
    with h5py.File(path, "w", userblock_size=SEAL) as file:
        packed = {"compression": "gzip", "compression_opts": 1, "shuffle": True, "fletcher32": True}
        image = (frames, height, width, 4)
        cdt = file.create_dataset("observables/cdt/value", image, "<f4", chunks=(1, *image[1:]), **packed)
        for frame in range(frames):
            rows[frame + 1] = read(states, "<f4", n, record["words"])
            cdt[frame] = read(states, "<f4", *image[1:])
        if states.read(1):
            raise ValueError("more states than the first line says")
        for field in record["fields"]:
            first, count = field["offset"], field["components"]
            values = rows[..., first] if count == 1 else rows[..., first : first + count]
            path = f"particles/all/{field['name']}/value"
            file.create_dataset(path, data=values, chunks=(1, *values.shape[1:]), **packed)
        file["parameters/lockstep/scene"] = json.dumps(head["settings"])
        file["parameters/lockstep/name"] = head["scene"]
        file["parameters/lockstep/settings"] = f"{head['run']}, in WebGL2"
        file["parameters/lockstep/renderer"] = head["renderer"]
        if len(triangles) > 0:
            file["parameters/lockstep/obstacles/positions"] = corners
            file["parameters/lockstep/obstacles/triangles"] = triangles
        if profile:
            file["parameters/lockstep/profile"] = profile


def seal(path):
    with open(path, "r+b") as file:
        file.seek(SEAL)
        digest = hashlib.sha256(file.read()).hexdigest()
        text = f"lockstep trace 1\nbytes {os.path.getsize(path)}\nsha256 {digest}\n"
        file.seek(0)
        file.write(text.encode().ljust(SEAL, b"\0"))


def main(states_path, trace_path, profile_path=None):
    profile = open(profile_path).read() if profile_path else None
    temporary = f"{trace_path}.new"
    try:
        with gzip.open(states_path) as states:
            write(states, temporary, profile)
        seal(temporary)
        os.replace(temporary, trace_path)
    except (OSError, EOFError, ValueError, KeyError) as error:
        if os.path.exists(temporary):
            os.remove(temporary)
        sys.exit(f"trace_of_states: {states_path}: {error}")


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    main(*sys.argv[1:])
