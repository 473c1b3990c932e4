#!/usr/bin/env python3
"""Writes OUT/cost_law.md and .json: the time of a step by particles n and radius r, fitted by one law, a + n (b + c (2r + 1)^2),
of what `lockstep bench` measures here, of what it measured on an H200, and of the thesis's table 4-1.
Usage: scripts/cost_law.py LOCKSTEP OUT [--gl KIND] [--scene FILE] [--counts N,...] [--radii R,...] [--frames N]
           [--repeats N] [--commit NAME]
  --repeats   runs, one after the other; of each cell the least of their medians counts"""
import argparse
import json
import pathlib
import shutil
import subprocess
import sys
from statistics import median

from bench_runs import PASS, STEP, blocks_of, least_of_runs
from least_squares import least_squares

ROOT = pathlib.Path(__file__).resolve().parent.parent
KEPT = ROOT / "data/results/h200/bench.txt"
# Verdicts of the kept blocks without a title: plain shaders differ by rounding, exact ones agree.
TITLES = {"DIFFER": "bunny_a, corrected", "AGREE": "bunny_a, exact"}
THESIS_COUNTS = (50000, 100000, 150000, 200000)
THESIS = {"bunny A": (12, 27, 52, 65), "bunny B": (13, 31, 50, 70), "dragon A": (12, 34, 54, 81), "dragon B": (14, 34, 56, 83)}


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("lockstep")
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--gl", default="auto")
    parser.add_argument("--scene", default="data/scenes/lattice.json")
    parser.add_argument("--counts", default="12500,25000,50000,100000,200000")
    parser.add_argument("--radii", default="0,1,2,3,4,5,6,7,8")
    parser.add_argument("--frames", type=int, default=10)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--commit")
    return parser.parse_args()


def texels(radius):
    return (2 * radius + 1) ** 2


def law(cells, what):
    """a in ms, b and c in ns, the median and the largest deviation, of (radius, particles, what) -> ms."""
    (a, b, c), off = least_squares([[1.0, n, n * texels(r), ms] for (r, n, of), ms in cells.items() if of == what])
    return {"a_ms": a, "b_ns": b * 1e6, "c_ns": c * 1e6, "median_deviation": median(off), "largest_deviation": max(off)}


def off_text(fit):
    return f"{100 * fit['median_deviation']:.1f} | {100 * fit['largest_deviation']:.0f}"


def row(name, fit):
    return f"| {name} | {fit['a_ms']:.3f} | {fit['b_ns']:.2f} | {fit['c_ns']:.3f} | {off_text(fit)} |"


def fits_table(fits):
    return ["| | a, ms | b, ns | c, ns | off %, median | at most |", "|---|---:|---:|---:|---:|---:|", *(row(*item) for item in fits.items())]


def cells_table(cells):
    counts = sorted({n for _, n, _ in cells})
    lines = ["| radius | texels | " + " | ".join(f"{n:,}" for n in counts) + " |", "|---:|---:|" + "---:|" * len(counts)]
    for r in sorted({r for r, _, _ in cells}):
        lines.append(f"| {r} | {texels(r)} | " + " | ".join(f"{cells[r, n, STEP]:.1f}" for n in counts) + " |")
    return lines


def kept_fits():
    merged = {}
    for block in blocks_of(KEPT.read_text()):
        merged.setdefault(block["title"] or TITLES[block["verdict"]], {}).update(block["cells"])
    return {title: law(cells, STEP) for title, cells in merged.items()}


def thesis_table():
    lines = ["| | a, ms | b + c (2r + 1)^2, ns | off %, at most |", "|---|---:|---:|---:|"]
    for name, cells in THESIS.items():
        (a, slope), off = least_squares([[1.0, n, ms] for n, ms in zip(THESIS_COUNTS, cells)])
        lines.append(f"| {name} | {a:.1f} | {slope * 1e6:.0f} | {100 * max(off):.0f} |")
    return lines


def commit_of(asked):
    if asked.commit or shutil.which("git") is None:
        return asked.commit or "an unknown commit"
    done = subprocess.run(["git", "describe", "--always", "--dirty", "--abbrev=7"], cwd=ROOT, capture_output=True, text=True)
    return done.stdout.strip() or "an unknown commit"


def main():
    asked = options()
    asked.out.mkdir(parents=True, exist_ok=True)
    gl, cells = least_of_runs(asked.repeats, [asked.lockstep, "bench", asked.scene, "--gl", asked.gl, "--counts", asked.counts,
                                              "--radius", asked.radii, "--frames", asked.frames])
    here, kept = {what: law(cells, what) for what in (STEP, PASS)}, kept_fits()
    command = " ".join(["scripts/cost_law.py LOCKSTEP OUT", *sys.argv[3:]])
    page = ["# The cost of a step: a + n (b + c (2r + 1)^2)", "", f"{gl}, at {commit_of(asked)}.", "", f"    {command}", "",
            f"Least squares in proportion. {asked.scene}, ms a step by the GL timer, median of {asked.frames} frames twice, the "
            f"least of {asked.repeats} runs:", "", *cells_table(cells), "", *fits_table(here),
            "", "## NVIDIA H200", "", f"The whole step in `{KEPT.relative_to(ROOT)}`, radii 1 and 4 alone:", "", *fits_table(kept),
            "", "## The thesis's table 4-1", "", "One radius, which it does not say, so that b and c are one number:", "",
            *thesis_table()]
    (asked.out / "cost_law.md").write_text("\n".join(page) + "\n")
    rows = [{"radius": r, "particles": n, "what": what, "ms": ms} for (r, n, what), ms in cells.items() if what in here]
    kept_json = {"gl": gl, "commit": commit_of(asked), "command": command, "cells": rows, "fits": here, "h200": kept}
    (asked.out / "cost_law.json").write_text(json.dumps(kept_json, indent=1) + "\n")
    print("\n".join(page))


main()
