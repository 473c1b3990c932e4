"""What `lockstep bench` prints of collision scenes, read, and the least of several runs."""
import re
import subprocess
import sys

WALL, STEP, PASS = "until GL has finished", "the whole step", "the collision pass alone"  # the latter two by the GL timer


def blocks_of(text):
    """Of each run its title, its GL, the last verdict, and (radius, particles, what) -> milliseconds."""
    blocks, title, before = [], None, ""
    for line in text.splitlines():
        words = line.split()
        if line.startswith("## "):
            title = line[3:]
        elif " each, " in line:
            blocks.append({"title": title, "gl": before, "verdict": None, "cells": {}})
        elif len(words) >= 10 and words[0].isdigit() and words[1].isdigit():
            cell, cells = (int(words[0]), int(words[1])), blocks[-1]["cells"]
            cells[(*cell, WALL)], cells[(*cell, STEP)] = float(words[2]), float(words[3])
            blocks[-1]["verdict"] = words[9]
        elif found := re.search(r"collision_pass ([0-9.]+)", line):
            cells[(*cell, PASS)] = float(found[1])
        before = line
    return blocks


def least_of_runs(repeats, words):
    """The GL, and of each cell the least of the runs' medians."""
    least = {}
    for _ in range(repeats):
        print("+", *words, file=sys.stderr, flush=True)
        done = subprocess.run(list(map(str, words)), capture_output=True, text=True)
        if done.returncode not in (0, 1):
            sys.exit(done.stdout + done.stderr)
        (block,) = blocks_of(done.stdout)
        for cell, ms in block["cells"].items():
            least[cell] = min(ms, least.get(cell, ms))
    return block["gl"], least
