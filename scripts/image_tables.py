#!/usr/bin/env python3
"""Writes OUT/image_tables.md and .json: what the systems lights and fluid take on a GL, and whether all images have one hash.
  lights   frame times by number of lights, forward and deferred, in two grids, fitted by light, voxel and pixel;
           how long the same number of atomics takes by itself
  fluid    the filters by radius
  hashes   preset exact, both sides run free: each frame's hash of all images, in OUT/image_hashes.txt
Usage: scripts/image_tables.py LOCKSTEP OUT [--gl KIND] [--parts lights,fluid,hashes] [--lights-up-to N] [--frames N]
           [--seconds N] [--runs NAME,...] [--side cpu|gpu] [--known FILE] [--table-frames N] [--twins] [--scenes DIR]
           [--commit NAME] [--cores N] [--range METRES]
  --frames, --seconds  of the hashes: how many frames, and when those that still run are ended; their verdict is then of
                       the frames before
  --runs               of the hashes: these alone, in this order, as the table names them
  --side               of the hashes: this side alone
  --known              of the hashes: GL alone, beside the first hash in each line of a file as OUT/image_hashes.txt is
  --twins              times the reference as well
  --range              of every light; otherwise the scene's 4 m, in which a light reaches 268 voxels
Exit status: 0 every hash is equal, 1 one is not, 2 a part could not be run."""
import argparse
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time

from least_squares import least_squares

ROOT = pathlib.Path(__file__).resolve().parent.parent
GRIDS = ((64, 16, 64), (128, 32, 128))
COUNTS = (1024, 4096, 16384, 65536, 262144, 1048576)
IMAGES = ((640, 360), (1280, 720), (1920, 1080))
# What a filter's size follows from, a key of a scene's "fluid": narrow_range takes its radius from the spheres'.
SIZES = {"filter_radius": (1, 3, 7, 15, 31), "radius": (0.01, 0.02, 0.04), "flow_iterations": (15, 30, 60)}
FILTERS = {"gaussian": ("filter=gaussian", "filter_shape=separable_vh"),
           "gaussian, full2d": ("filter=gaussian", "filter_shape=full2d"),
           "bilateral": ("filter=bilateral", "filter_shape=separable_vh"),
           "bilateral, full2d": ("filter=bilateral", "filter_shape=full2d"),
           "narrow_range": ("filter=narrow_range",),
           "curvature_flow": ("filter=curvature_flow",)}
DROPS = 100000


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("lockstep")
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--gl", default="auto")
    parser.add_argument("--parts", default="lights,fluid,hashes")
    parser.add_argument("--lights-up-to", type=int, default=COUNTS[-1])
    parser.add_argument("--frames", type=int, default=100)
    parser.add_argument("--seconds", type=float, default=240)
    parser.add_argument("--runs", type=lambda names: names.split(","))
    parser.add_argument("--side", choices=("cpu", "gpu"))
    parser.add_argument("--known", type=pathlib.Path)
    parser.add_argument("--table-frames", type=int, default=5)
    parser.add_argument("--twins", action="store_true")
    parser.add_argument("--scenes", type=pathlib.Path, default=ROOT / "data/scenes")
    parser.add_argument("--commit")
    parser.add_argument("--cores", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--range", type=float)
    return parser.parse_args()


class Run:
    """What was asked, and the scenes that are made of the shipped ones."""

    def __init__(self, asked):
        self.asked = asked
        self.scenes = asked.out / "scenes"
        self.scenes.mkdir(parents=True, exist_ok=True)
        self.counts = sorted({n for n in COUNTS if n < asked.lights_up_to} | {asked.lights_up_to})
        self.gl = ""

    def lights(self, grid, image):
        """Crowd in another grid and image, with lights whose balls lie wholly in the grid."""
        scene = json.loads((self.asked.scenes / "lights/crowd.json").read_text())
        x, y, z = grid
        scene["grid"].update(size=list(grid), origin=[-x // 2, 0, -z // 2])
        scene["image"] = list(image)
        for group in scene["lights"]:
            r = group["range"] = self.asked.range or group["range"]
            group.update(min=[r - x / 2, r, r - z / 2], max=[x / 2 - r, y - r, z / 2 - r])
        return self.kept(f"lights_{x}x{y}x{z}_{image[0]}x{image[1]}{self.ranged()}", scene)

    def ranged(self):
        return f"_range_{self.asked.range:g}" if self.asked.range else ""

    def fluid(self, shipped, **fluid):
        scene = json.loads((self.asked.scenes / f"fluid/{shipped}.json").read_text())
        scene["fluid"].update(fluid)
        return self.kept("_".join([shipped, *(f"{name}_{value}" for name, value in fluid.items())]), scene)

    def kept(self, name, scene):
        file = self.scenes / f"{name}.json"
        file.write_text(json.dumps(scene))
        return file

    def bench(self, scene, counts, settings, *more):
        """Of each count the milliseconds of each row: GL, the GPU's clock and the twin. Rows of one name are added up."""
        twins = [] if self.asked.twins else ["--gl-only"]
        words = [self.asked.lockstep, "bench", scene, "--counts", ",".join(map(str, counts)), "--gl", self.asked.gl, "--frames",
                 self.asked.table_frames, "--warm-up", 1, *(w for s in settings for w in ("--set", s)), *twins, *more]
        lines = output_of(words)
        self.gl = lines[0]
        rows = {count: {} for count in counts}
        for line in map(str.split, lines[4:]):
            if line[1].endswith(":"):
                continue
            row = rows[int(line[0])].setdefault(line[1], [0.0, 0.0, 0.0])
            for i in range(3):
                row[i] += 0.0 if line[2 + i] == "-" else float(line[2 + i])
        return rows


def output_of(words):
    print("+", *words, file=sys.stderr, flush=True)
    done = subprocess.run(list(map(str, words)), capture_output=True, text=True)
    if done.returncode not in (0, 1):
        raise RuntimeError(done.stdout + done.stderr)
    return done.stdout.splitlines()


def fit_text(what, rows, units):
    """Of rows 1, numbers of each unit, milliseconds."""
    if len(rows) <= len(units) + 1:
        return []
    factors, missed = least_squares(rows)
    terms = [f"{factors[0]:.3f} ms"] + [f"{f * 1e6:.3g} ns a {unit}" for f, unit in zip(factors[1:], units)]
    return [f"- {what}: {' + '.join(terms)}; at most {100 * max(missed):.0f} % off"]


def table(head, rows):
    cells = [head, ["---"] * len(head), *rows]
    return ["", *("| " + " | ".join(row) + " |" for row in cells), ""]


def ms(x):
    return f"{x:.3f}" if x < 10 else f"{x:.1f}"


def sides(run):
    return (("GL", 1), ("twin", 2)) if run.asked.twins else (("GL", 1),)


def lights_tables(run):
    text, kept = ["## Lights: frame times", "",
                  f"Scene crowd at 640 x 360, range {run.asked.range or 4:g} m, each light's ball wholly in the grid, `accumulate=fixed64`. Median milliseconds",
                  f"by the GPU's clock, frames: {run.asked.table_frames} after 1. Scatter: `light_volume_scatter` alone; atomics: as many",
                  "`imageAtomicAdd` and nothing else, at random and in one voxel."], {}
    fits = {}
    for grid in GRIDS:
        name = " x ".join(map(str, grid))
        scene = run.lights(grid, IMAGES[0])
        of = {p: run.bench(scene, run.counts, [f"pipeline={p}"], *(["--floor"] if p == "deferred" else []))
              for p in ("forward", "deferred")}
        kept[name] = of
        rows = []
        for count in run.counts:
            f, d = of["forward"][count], of["deferred"][count]
            scatter, random, one = (d[row][1] for row in ("light_volume_scatter", "atomics_at_random", "atomics_in_one_voxel"))
            rows.append([f"{count:,}", *(ms(x["frame"][side]) for _, side in sides(run) for x in (f, d)), ms(scatter),
                         ms(random), ms(one), f"{scatter / random:.2f}", f"{scatter / one:.2f}"])
            if run.asked.twins:
                twin = d["light_volume_scatter"][2]
                rows[-1] += [ms(twin), f"{scatter / twin:.1f}"]
        text += ["", f"### {name} voxels"]
        text += table(["lights", *(f"{side}: {p}" for side, _ in sides(run) for p in of), "scatter", "atomics at random",
                       "in one voxel", "scatter / random", "/ one voxel", *(["twin's scatter", "GL / twin"] if run.asked.twins else [])], rows)
        for p in of:
            for side, i in sides(run):
                points = [[1.0, count, row["frame"][i]] for count, row in of[p].items()]
                text += fit_text(f"{p}, {side}", points, ["light"])
                fits.setdefault((p, side), []).extend(
                    [1.0, n, grid[0] * grid[1] * grid[2], time] for _, n, time in points)
    text += ["", "### Both grids", ""]
    for (p, side), points in fits.items():
        text += fit_text(f"{p}, {side}", points, ["light", "voxel"])
    return text + pixels_table(run, kept), kept


def pixels_table(run, kept):
    count = min(16384, run.asked.lights_up_to)
    rows, points = [], {side: [] for side, _ in sides(run)}
    for image in IMAGES:
        found = run.bench(run.lights(GRIDS[0], image), [count], ["pipeline=deferred"])[count]
        kept[f"{image[0]} x {image[1]}"] = found
        of_pixels = [sum(x[side] for name, x in found.items()
                         if name.startswith(("gbuffer", "deferred", "glow", "encode"))) for _, side in sides(run)]
        rows.append([f"{image[0]} x {image[1]}", *(ms(x) for x in of_pixels)])
        for (side, _), x in zip(sides(run), of_pixels):
            points[side].append([1.0, image[0] * image[1], x])
    text = ["", f"### By pixels: {count:,} lights, deferred, the passes of the image"]
    text += table(["image", *(side for side, _ in sides(run))], rows)
    for side, of in points.items():
        text += fit_text(side, of, ["pixel"])
    return text


def fluid_tables(run):
    text, kept = ["", "## Fluid: filters by radius", "",
                  f"Scene dam, {DROPS:,} particles at 800 x 800; milliseconds of all steps of the filter by the GPU's clock."], {}
    both = " (GL / twin)" if run.asked.twins else ""
    for key, sizes in SIZES.items():
        rows = []
        for name, settings in FILTERS.items():
            if key != {"narrow_range": "radius", "curvature_flow": "flow_iterations"}.get(name, "filter_radius"):
                continue
            cells = []
            for size in sizes:
                found = run.bench(run.fluid("dam", **{key: size}), [DROPS], settings)[DROPS]
                kept[f"{name}, {key} {size}"] = found
                cells.append(" / ".join(ms(found["depth_filter_pass"][side]) for _, side in sides(run)))
            rows.append([name, *cells])
        text += table([f"filter{both}", *(f"`{key}` {size}" for size in sizes)], rows)
    return text, kept


def hash_jobs(run):
    """Name, scene, items, settings and threads, those that take longest last."""
    few, many = max(1, run.asked.cores // 8), max(1, run.asked.cores // 2)
    jobs = [(f"fluid_{name}", run.fluid("wave"), DROPS, [f"filter={name}"], few)
            for name in ("gaussian", "bilateral", "narrow_range", "curvature_flow")]
    for count in (n for n in run.counts if n in (1024, 16384, 131072) or n == run.counts[-1]):
        for grid in GRIDS:
            name = f"lights_{count}_in_{'x'.join(map(str, grid))}{run.ranged()}"
            jobs.append((name, run.lights(grid, IMAGES[0]), count, [], many if count > 100000 else few))
    if run.asked.runs is None:
        return jobs
    of = {job[0]: job for job in jobs}
    for name in run.asked.runs:
        if name not in of:
            raise RuntimeError(f"--runs: no run is named {name}; there are {', '.join(of)}")
    return [of[name] for name in run.asked.runs]


def hashed(run, jobs):
    """Runs jobs side by side as far as there are cores; ends what still runs when the time is up. Of each its report."""
    asked, waiting, running, reports = run.asked, list(jobs), {}, {}
    end = time.monotonic() + asked.seconds
    (asked.out / "hashes").mkdir(exist_ok=True)
    while waiting or running:
        over = time.monotonic() > end
        while waiting and not over and (not running or sum(job[4] for job in running.values()) + waiting[0][4] <= asked.cores):
            job = waiting.pop(0)
            name, scene, items, settings, threads = job
            file = asked.out / "hashes" / f"{name}.txt"
            how = (["hash", scene, "--side", asked.side, "--every"] if asked.side
                   else ["check", scene, "--mode", "free", "--no-render", "--hashes", file])
            gl = [] if asked.side == "cpu" else ["--gl", asked.gl]
            words = [asked.lockstep, *how, "--preset", "exact", "--particles", items, "--frames", asked.frames, *gl,
                     "--threads", threads, *(w for s in settings for w in ("--set", s))]
            print("+", *words, file=sys.stderr, flush=True)
            process = subprocess.Popen(list(map(str, words)), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
            running[process] = job
        for process, job in list(running.items()):
            if over and process.poll() is None:
                process.send_signal(signal.SIGINT)
            if over or process.poll() is not None:
                reports[job[0]] = process.communicate()[0]
                del running[process]
        if over:
            waiting.clear()
        time.sleep(0.2)
    return reports


def known_hashes(asked):
    """Of each run the known hash by frame."""
    known = {}
    for line in asked.known.read_text().splitlines() if asked.known else ():
        if not line.startswith("#"):
            name, frame, cpu = line.split()[:3]
            known.setdefault(name, {})[frame] = cpu
    return known


def hashes_table(run):
    jobs = hash_jobs(run)
    known = known_hashes(run.asked)
    if run.asked.known:
        jobs = [job for job in jobs if job[0] in known]
    reports = hashed(run, jobs)
    rows, kept, lines = [], {}, []
    for name, _, items, _, _ in jobs:
        file = run.asked.out / "hashes" / f"{name}.txt"
        report = dict(line.split(None, 1) for line in reports.get(name, "").splitlines() if len(line.split(None, 1)) == 2)
        if run.asked.side:
            printed = reports.get(name, "")
        else:
            printed = file.read_text() if name in reports and file.exists() else ""
        found = [line.split() for line in printed.splitlines() if re.fullmatch(r"\d+( [0-9a-f]{16})+", line)]
        if run.asked.known:
            found = [[frame, known[name][frame], gpu] for frame, gpu in found if frame in known[name]]
        lines += [" ".join([name, *row]) for row in found]
        both = [row[1:] for row in found if len(row) == 3]
        equal = [a == b for a, b in both]
        kept[name] = {"items": items, "frames": len(found), "compared": len(both), "equal": sum(equal),
                      "last": found[-1][1] if found else None,
                      "verdict": report.get("verdict", reports.get(name, "was not begun").strip())}
        last = f"`{found[-1][-1]}`" if found else kept[name]["verdict"]
        rows.append([name, f"{items:,}", str(len(found)), f"{sum(equal)} of {len(equal)}" if both else "-", last])
    sides = "GL alone" if run.asked.known else f"the {run.asked.side.upper()} side alone" if run.asked.side else "both sides"
    (run.asked.out / "image_hashes.txt").write_text("\n".join([f"# run, frame, hash of all images: {sides}", *lines]) + "\n")
    how = f"hash --side {run.asked.side} --every" if run.asked.side else "check --mode free"
    text = ["", "## One hash for all images of a frame", "",
            f"`lockstep {how} --preset exact --frames {run.asked.frames}`, ended after {run.asked.seconds:g} seconds in all; "
            "lights at 640 x 360, fluid (scene wave)", "at 800 x 800. Every frame's hashes are in `image_hashes.txt`."]
    return text + table(["run", "items", "frames", "equal on CPU and GL", "after the last"], rows), kept


def commit_of(asked):
    if asked.commit:
        return asked.commit
    if shutil.which("git") is None:
        return "an unknown commit"
    done = subprocess.run(["git", "describe", "--always", "--dirty", "--abbrev=7"], cwd=ROOT, capture_output=True, text=True)
    return done.stdout.strip() or "an unknown commit"


def main():
    asked = options()
    asked.side = "gpu" if asked.known else asked.side
    asked.out.mkdir(parents=True, exist_ok=True)
    run = Run(asked)
    parts = {"lights": lights_tables, "fluid": fluid_tables, "hashes": hashes_table}
    text, kept, seconds, failed = [], {}, {}, False
    for part in asked.parts.split(","):
        begun = time.monotonic()
        try:
            lines, kept[part] = parts[part](run)
        except RuntimeError as error:
            failed, lines = True, ["", f"## {part}: not run to the end", "", f"    {str(error).strip()}"]
        seconds[part] = round(time.monotonic() - begun)
        text += lines
    if asked.side == "cpu":
        run.gl = "no GL"
    if not run.gl:
        run.bench(run.lights(GRIDS[0], IMAGES[0]), [1], [])
    took = ", ".join(f"{part} {n} s" for part, n in seconds.items())
    head = ["# Lights and fluid", "", f"{run.gl}, at {commit_of(asked)}; {asked.cores} cores; {took}.", "",
            f"    {' '.join(['scripts/image_tables.py LOCKSTEP OUT', *sys.argv[3:]])}", ""]
    page = re.sub(r"\n{3,}", "\n\n", "\n".join(head + text)).rstrip() + "\n"
    (asked.out / "image_tables.md").write_text(page)
    (asked.out / "image_tables.json").write_text(json.dumps({"gl": run.gl, "commit": commit_of(asked), "seconds": seconds, **kept},
                                                            indent=1) + "\n")
    print(page, end="")
    wrong = [name for name, one in kept.get("hashes", {}).items() if one["equal"] != one["compared"]]
    sys.exit(2 if failed else 1 if wrong else 0)


main()
