#!/usr/bin/env python3
"""Writes OUT/crossover.md and .json: a step's time with search=cdt and with search=octree by particles, and where they cross.
Usage: scripts/crossover.py LOCKSTEP OUT [--gl KIND] [--scenes FILE,...] [--counts N,...] [--frames N] [--repeats N]
           [--commit NAME]
  --repeats   runs, one after the other; of each cell the least of their medians counts"""
import argparse
import json
import pathlib
import sys

from bench_runs import WALL, least_of_runs

SEARCHES = {"CDT": ["search=cdt"], "octree, root 2": ["search=octree", "octree_size=2"],
            "octree, root 50": ["search=octree", "octree_size=50"]}


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("lockstep")
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--gl", default="auto")
    parser.add_argument("--scenes", default="data/scenes/x_streams.json,data/scenes/bunny_b.json")
    parser.add_argument("--counts", default="500,1000,2000,4000,8000,16000,32000")
    parser.add_argument("--frames", type=int, default=5)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--commit", default="an unknown commit")
    return parser.parse_args()


def times(asked, scene, settings):
    """The GL, and milliseconds by particles."""
    words = [asked.lockstep, "bench", scene, "--gl", asked.gl, "--counts", asked.counts, "--radius", 1, "--frames", asked.frames]
    gl, cells = least_of_runs(asked.repeats, words + [word for s in settings for word in ("--set", s)])
    return gl, {n: ms for (_, n, what), ms in cells.items() if what == WALL}


def crossing(cdt, octree):
    """From how many particles on the CDT is faster, on lines between the measured counts."""
    ahead = {n: octree[n] - cdt[n] for n in sorted(cdt)}
    counts = list(ahead)
    slower = [i for i, n in enumerate(counts) if ahead[n] <= 0]
    if not slower:
        return f"below {counts[0]:,}"
    if slower[-1] + 1 == len(counts):
        return f"above {counts[-1]:,}"
    x, y = counts[slower[-1]], counts[slower[-1] + 1]
    return f"{x + (y - x) * ahead[x] / (ahead[x] - ahead[y]):,.0f}"


def main():
    asked = options()
    asked.out.mkdir(parents=True, exist_ok=True)
    counts = [int(n) for n in asked.counts.split(",")]
    lines, kept = [], {}
    for scene in asked.scenes.split(","):
        of = kept[pathlib.Path(scene).stem] = {}
        for name, settings in SEARCHES.items():
            gl, of[name] = times(asked, scene, settings)
            crossed = "" if name == "CDT" else crossing(of["CDT"], of[name])
            cells = " | ".join(f"{of[name][n]:.1f}" for n in counts)
            lines.append(f"| {pathlib.Path(scene).stem} | {name} | {cells} | {crossed} |")
    command = " ".join(["scripts/crossover.py LOCKSTEP OUT", *sys.argv[3:]])
    page = ["# Where CDT and octree cross", "", f"{gl}, at {asked.commit}.", "", f"    {command}", "",
            f"ms a step until GL has finished, the octree's refresh included, radius 1, median of {asked.frames} frames twice, the "
            f"least of {asked.repeats} runs:", "",
            "| scene | search | " + " | ".join(f"{n:,}" for n in counts) + " | CDT faster from |",
            "|---|---|" + "---:|" * (len(counts) + 1), *lines]
    (asked.out / "crossover.md").write_text("\n".join(page) + "\n")
    (asked.out / "crossover.json").write_text(
        json.dumps({"gl": gl, "commit": asked.commit, "command": command, "ms": kept}, indent=1) + "\n")
    print("\n".join(page))


main()
