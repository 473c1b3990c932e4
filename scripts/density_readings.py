#!/usr/bin/env python3
"""Writes OUT/density_readings.md and .json: the time of a step at density A over that at density B, by what the thesis leaves
open of its emitters. Below 1, A is faster, as in table 4-1.
Usage: scripts/density_readings.py LOCKSTEP OUT [--gl KIND] [--counts N,...] [--repeats N] [--seconds S] [--only NAME]...
           [--commit NAME]
  --repeats   runs of A and of B by turns; the median of the turns' ratios counts
  --seconds   no reading begins after these"""
import argparse
import json
import pathlib
import subprocess
import sys
import time
from statistics import median

ROOT = pathlib.Path(__file__).resolve().parent.parent

NARROW = ([-0.3, 0.15, -0.25], [0.3, 0.65, 0.25])  # density A as shipped
PILES = {"gravity": [0, -0.03, 0], "collision_range": 0.01, "collision_time": 0.01}


def box(scene, low, high):
    scene["emitters"][0] |= {"min": low, "max": high}


def wider(scene, density):
    box(scene, *(NARROW if density == "a" else ([-0.6, 0.15, -0.5], [0.6, 0.65, 0.5])))


def longer(scene, density):
    box(scene, *(NARROW if density == "a" else ([-0.3, 0.15, -0.25], [0.3, 2.15, 0.25])))


def small_a(scene, density):
    if density == "a":
        box(scene, [-0.1, 0.3, -0.1], [0.1, 0.5, 0.1])


def cells(scene, _):
    """Particles of one column of the picture side by side in memory: 16 x 16 boxes, row by row."""
    (whole,) = scene["emitters"]
    (x0, y0, z0), (x1, y1, z1), n = whole["min"], whole["max"], 16
    at = lambda low, high, i: low + (high - low) * i / n
    scene["emitters"] = [whole | {"count": 1000, "min": [at(x0, x1, i), at(y0, y1, j), z0], "max": [at(x0, x1, i + 1), at(y0, y1, j + 1), z1]}
                         for j in range(n) for i in range(n)]


def setting(*path):
    """Of a scene: path[:-1] leads to the key that becomes path[-1]."""
    def change(scene, _):
        *folders, key, value = path
        for folder in folders:
            scene = scene[folder] if isinstance(scene, list) else scene.setdefault(folder, {})
        scene[key] = value
    return change


def piles(scene, _):
    """The constants under which bunny and dragon have piles (docs/thesis.md)."""
    scene.setdefault("constants", {}).update(PILES)
    scene.setdefault("switches", {})["speed_factor"] = 0.2


def waits(seconds):
    return setting("constants", "collision_time", seconds)


def eye(*place):
    return setting("camera", "eye", list(place))


EARLY, LATE = 40, 600
# By worth; name: (changes to both scenes, frames, radius)
READINGS = {
    "as shipped": ([], EARLY, 1),
    "radius 4": ([], EARLY, 4),
    "radius 8": ([], EARLY, 8),
    "piles": ([piles], LATE, 1),
    "piles, radius 8": ([piles], LATE, 8),
    "late": ([], LATE, 1),
    "who hits waits 2 s, radius 8": ([waits(2.0)], EARLY, 8),
    "who hits searches on, radius 8": ([waits(0.0)], EARLY, 8),
    "memory by columns of the picture": ([cells], EARLY, 1),
    "memory by columns, radius 8": ([cells], EARLY, 8),
    "memory row by row, a lattice": ([setting("emitters", 0, "shape", "lattice")], EARLY, 1),
    "B wider, as high, radius 4": ([wider], EARLY, 4),
    "B longer along the fall, radius 4": ([longer], EARLY, 4),
    "A a small cube, radius 4": ([small_a], EARLY, 4),
    "image 2000 x 2000": ([setting("image", [2000, 2000])], EARLY, 1),
    "image 4000 x 4000, radius 8": ([setting("image", [4000, 4000])], EARLY, 8),
    "image 125 x 125": ([setting("image", [125, 125])], EARLY, 1),
    "near camera": ([eye(0, 0.25, 1.2)], EARLY, 1),
    "far camera": ([eye(0, 0.25, 6)], EARLY, 1),
    "from above": ([eye(0, 2.4, 0.3)], EARLY, 1),
    "from the side": ([eye(2.4, 0.25, 0)], EARLY, 1),
    "piles, B wider": ([piles, wider], LATE, 1),
    "piles, B longer": ([piles, longer], LATE, 1),
    "piles, from above": ([piles, eye(0, 2.4, 0.3)], LATE, 1),
    "radius 0": ([], EARLY, 0),
}


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("lockstep")
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--gl", default="auto")
    parser.add_argument("--counts", default="50000,200000")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--seconds", type=float, default=1e9)
    parser.add_argument("--only", action="append", choices=READINGS)
    parser.add_argument("--commit", default="an unknown commit")
    return parser.parse_args()


def scene_file(asked, name, changes, density):
    folder = asked.out / "scenes"
    folder.mkdir(parents=True, exist_ok=True)
    scene = json.loads((ROOT / f"data/scenes/bunny_{density}.json").read_text())
    for change in changes:
        change(scene, density)
    scene["obstacles"][0]["file"] = str(ROOT / "data/meshes/bunny.obj")
    path = folder / f"{name.replace(' ', '_').replace(',', '')}_{density}.json"
    path.write_text(json.dumps(scene, indent=1) + "\n")
    return path


def bench(asked, scene, frames, radius):
    """The GL, and milliseconds a step by particles: the GL timer's where there is one."""
    words = [asked.lockstep, "bench", scene, "--gl", asked.gl, "--gl-only", "--no-render", "--frames", frames, "--radius", radius,
             "--counts", asked.counts]
    done = subprocess.run(list(map(str, words)), capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stdout + done.stderr)
    rows = [line.split() for line in done.stdout.splitlines()]
    return done.stdout.splitlines()[0], {int(r[1]): float(r[3]) or float(r[2]) for r in rows if len(r) == 4 and r[0].isdigit()}


def ratios_text(ms):
    """Median, least and largest of what the turns gave."""
    ratios = [a / b for a, b in zip(ms["a"], ms["b"])]
    return f"{median(ratios):.3f} ({min(ratios):.3f} to {max(ratios):.3f})"


def main():
    asked = options()
    asked.out.mkdir(parents=True, exist_ok=True)
    start, rows, gl, counts = time.monotonic(), [], "", list(map(int, asked.counts.split(",")))
    for name in asked.only or READINGS:
        if time.monotonic() - start > asked.seconds:
            break
        changes, frames, radius = READINGS[name]
        scenes = {density: scene_file(asked, name, changes, density) for density in "ab"}
        turns = [{density: bench(asked, scenes[density], frames, radius) for density in ("ba" if turn % 2 else "ab")}
                 for turn in range(asked.repeats if frames == EARLY else max(1, asked.repeats // 3))]
        gl = turns[0]["a"][0]
        ms = {n: {density: [turn[density][1][n] for turn in turns] for density in "ab"} for n in counts}
        rows.append({"reading": name, "frames": frames, "radius": radius, "ms": ms})
        print(name, {n: ratios_text(of) for n, of in ms.items()}, f"{time.monotonic() - start:.0f} s", flush=True)
    command = " ".join(["scripts/density_readings.py LOCKSTEP OUT", *sys.argv[3:]])
    heads = [f"A, {n:,} | B | A / B" for n in counts]
    lines = ["| reading | frames | radius | " + " | ".join(heads) + " |", "|---|---:|---:|" + "---:|" * 3 * len(counts)]
    for row in rows:
        of = [f"{median(ms['a']):.3f} | {median(ms['b']):.3f} | {ratios_text(ms)}" for ms in row["ms"].values()]
        lines.append(f"| {row['reading']} | {row['frames']} | {row['radius']} | " + " | ".join(of) + " |")
    page = ["# Density A beside density B, by what is open", "", f"{gl}, at {asked.commit}.", "", f"    {command}", "",
            f"ms a step, medians of the frames and of {asked.repeats} runs by turns (of 600 frames a third as many); of the turns' ratios the "
            "median, the least and the largest:", "", *lines]
    (asked.out / "density_readings.md").write_text("\n".join(page) + "\n")
    (asked.out / "density_readings.json").write_text(json.dumps({"gl": gl, "commit": asked.commit, "command": command, "rows": rows}, indent=1) + "\n")


main()
