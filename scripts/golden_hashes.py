#!/usr/bin/env python3
"""Writes data/golden/SCENE.json: the reference's state hash of every shipped scene, of the meshes that are there. They
change only when the algorithm or a scene does; tests/collision/golden_hash_test.cpp holds them. Hashes of other meshes,
as another release of the library that reduces them makes them, stay: run it there, too.
Usage: scripts/golden_hashes.py LOCKSTEP [SCENE.json ...]"""
import json
import pathlib
import subprocess
import sys
import zlib

frames, particles = 30, 5000
presets, profiles = ("paper", "corrected", "exact"), ("strict", "llvmpipe")


def state_hash(lockstep, scene, preset, profile):
    command = [lockstep, "hash", str(scene), "--frames", str(frames), "--particles", str(particles)]
    command += ["--preset", preset, "--profile", profile]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.split()[1]


def text(hashes, indent):
    lines = [f'{indent}  "{preset}": {{ ' + ", ".join(f'"{p}": "{h}"' for p, h in of_profile.items()) + " }"
             for preset, of_profile in hashes.items()]
    return "{\n" + ",\n".join(lines) + "\n" + indent + "}"


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    root = pathlib.Path(__file__).resolve().parent.parent
    (root / "data/golden").mkdir(exist_ok=True)
    for scene in [pathlib.Path(file) for file in sys.argv[2:]] or sorted((root / "data/scenes").glob("*.json")):
        hashes = {preset: {p: state_hash(sys.argv[1], scene, preset, p) for p in profiles} for preset in presets}
        obstacles = json.loads(scene.read_text()).get("obstacles", [])
        mesh = next((scene.parent / one["file"] for one in obstacles if "file" in one), None)
        golden = root / "data/golden" / scene.name
        lines = [f'  "frames": {frames}', f'  "particles": {particles}']
        if mesh is None:
            lines.append('  "hashes": ' + text(hashes, "  "))
        else:
            meshes = json.loads(golden.read_text()).get("meshes", {}) if golden.exists() else {}
            meshes[f"{zlib.crc32(mesh.read_bytes()):08x}"] = hashes
            of_each = [f'    "{crc}": ' + text(known, "    ") for crc, known in meshes.items()]
            lines.append('  "meshes": {\n' + ",\n".join(of_each) + "\n  }")
        golden.write_text("{\n" + ",\n".join(lines) + "\n}\n")


main()
