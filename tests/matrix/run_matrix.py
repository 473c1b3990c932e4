#!/usr/bin/env python3
"""Runs every verb on every system with shaders of every verdict class and writes every output: what a report line indexes,
joins or prints is executed for each class, also for those that no shipped scene gives on llvmpipe. Cases marked all_verbs
in cases.json go through all verbs, the others through `check`. CI runs it with a program
that was built with sanitizers (scripts/sanitize.sh), whose reports end a run with exit status 99.

Held of each run: the exit status and the verdict that cases.json expects, no signal, no sanitizer report, an end in time,
outputs that parse.
Usage: tests/matrix/run_matrix.py PROGRAM [--short] [--only SUBSTRING] [--jobs N] [--keep DIR]
--short: of the cases marked all_verbs only those named divergent, whose reports have the most lines, go through all verbs.
Exit status: 0 all held, 1 not."""

import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree

root = pathlib.Path(__file__).resolve().parent.parent.parent
here = pathlib.Path(__file__).resolve().parent
limit_s = 300
# What the program says of a child process that ended with a report: behind its fence that reaches no terminal.
child_fault = r"ended the process|crashed with signal|needs too much memory|did not answer within|s of processor time"


class Run:
    """The runs of one case, in a folder of its own."""

    def __init__(self, program, name, case, system, folder):
        self.program, self.name, self.case, self.folder = program, name, case, folder
        self.system = {**system, "options": case.get("instead", system.get("options", []))}
        self.problems, self.count, self.seconds, self.slowest = [], 0, 0.0, (0, "")
        self.scene = self.write_scene()
        self.shaders = self.write_changed("--shaders", "mine", case.get("changes"))
        self.reference = self.write_changed("--reference", "reference", case.get("reference"))

    def write_scene(self):
        scene = case_scene(self.case, self.system)
        if isinstance(scene, str):
            return str(root / scene)
        path = self.folder / "scene.json"
        path.write_text(json.dumps(scene), encoding="utf-8")
        return str(path)

    def write_changed(self, option, name, changes):
        """The option with a folder of shaders in which texts are replaced by others."""
        if not changes:
            return []
        folder = self.folder / name
        folder.mkdir()
        for file, text, other in changes:
            path = folder / file
            source = path if path.exists() else shipped(self.system["shaders"], file)
            before = source.read_text(encoding="utf-8")
            if text not in before:
                self.problems.append(f"{self.name}: '{text}' is not in {file}")
            path.write_text(before.replace(text, other), encoding="utf-8")
        return [option, str(folder)]

    def program_run(self, words, statuses, typed=None):
        """The output of one run; notes a problem where its end is not one of `statuses`, or its JSON is none."""
        self.count += 1
        words = [str(word) for word in words]
        started = time.monotonic()
        try:
            done = subprocess.run([self.program, *words], input=typed, capture_output=True, text=True, errors="replace",
                                  timeout=limit_s, cwd=self.folder)
        except subprocess.TimeoutExpired:
            self.problems.append(f"{self.name}: {' '.join(words)}: no end within {limit_s} s")
            return ""
        seconds = time.monotonic() - started
        self.seconds, self.slowest = self.seconds + seconds, max(self.slowest, (seconds, " ".join(words[:2])))
        fault = re.search(child_fault, done.stderr)
        if done.returncode not in statuses or fault:
            kept = re.sub(r"[^A-Za-z0-9]+", "_", self.name) + ".log"
            self.problems.append(f"{self.name}: {' '.join(words)}: status {done.returncode}, expected "
                                 f"{' or '.join(map(str, statuses))}: {last_line(done.stderr)} ({kept})")
            (self.folder.parent / kept).write_text(done.stdout + done.stderr, encoding="utf-8")
        elif "--json" in words and done.returncode < 2:
            try:
                json.loads((self.folder / words[words.index("--json") + 1]).read_text(encoding="utf-8"))
            except (OSError, ValueError) as error:
                self.problems.append(f"{self.name}: {' '.join(words)}: {error}")
        return done.stdout

    def expect_lines(self, text, lines):
        for line in lines:
            if not re.search(line, text, re.M):
                self.problems.append(f"{self.name}: no line {line}")

    def check(self):
        """`check` with every output, then as text alone; runs the commands that its report prints."""
        status = self.case["status"]
        common = [*self.system["options"], *self.case.get("options", []), *self.shaders, *self.reference]
        outputs = ["--json", "report.json", "--hashes", "hashes.txt", "--report", "page", *self.system["outputs"]]
        text = self.program_run(["check", self.scene, *common, *outputs, "--power"], [status])
        verdict = re.search(r"^verdict +(.*)$", text, re.M)
        if not verdict or not re.search(self.case["verdict"], verdict[1]):
            self.problems.append(f"{self.name}: verdict '{verdict and verdict[1]}', expected {self.case['verdict']}")
        self.expect_lines(text, self.case.get("lines", []))
        if (self.folder / "junit.xml").exists():
            xml.etree.ElementTree.parse(self.folder / "junit.xml")
        hexed = self.program_run(["check", self.scene, *common, "--hex"], [status])
        for command in printed_commands(hexed)[:4]:
            self.program_run(command, [0, 1])

    def one_item(self):
        """explain, debug and capsules of one item."""
        common = [*self.system["item_options"], *self.case.get("options", []), *self.shaders]
        for item in self.system["items"]:
            explained = ["explain", self.scene, *common, *self.reference, "--frame", self.system["frame"], *item]
            self.program_run(explained, [0, 1, 2])
            self.program_run([*explained, "--json", "explain.json"], [0, 1, 2])
        self.program_run(["debug", self.scene, *common, *self.reference], [0, 1, 2], typed=self.system["debug"])
        for item in self.system["capsules"]:
            self.program_run(["capsule", "cut", self.scene, *common, "--frame", self.system["frame"], *item, "-o", "one.json"], [0, 1, 2])
            if (self.folder / "one.json").exists():
                self.program_run(["capsule", "show", "one.json"], [0, 1])

    def recorded(self):
        """The run in a file: judged as a whole, in parts that are merged, and as a page."""
        common = [*self.system["options"], *self.shaders]
        options = self.case.get("options", [])
        switches = [word for k, word in enumerate(options) if options[max(k - 1, 0)] in ("--preset", "--set") or word in ("--preset", "--set")]
        judged = [word for word in options if word not in switches]
        self.program_run(["record", self.scene, *common, *switches, "-o", "run.h5"], [0])
        if not (self.folder / "run.h5").exists():
            return
        self.program_run(["trace", "run.h5"], [0])
        self.program_run(["check", "--trace", "run.h5", *judged, "--json", "trace.json", "--report", "trace_page"], [0, 1])
        if self.system["shards"]:
            for k in (1, 2):
                self.program_run(["check", "--trace", "run.h5", *judged, "--shard", f"{k}/2", "--json", f"part{k}.json"], [0, 1])
            self.program_run(["merge", "part1.json", "part2.json"], [0, 1])
        self.program_run(["report", "run.h5", "-o", "run_page"], [0, 1, 2])

    def pictures(self):
        common = [*self.system["options"], *self.case.get("options", []), *self.shaders]
        sizes = [word for k, word in enumerate(common) if common[max(k - 1, 0)] == "--particles" or word == "--particles"]
        for side in ("cpu", "gpu"):
            shaders = self.shaders if side == "gpu" else []
            self.program_run(["render", self.scene, *sizes, *shaders, "--side", side, "--frame", "1", "-o", f"{side}.png"], [0, 2])
            self.program_run(["hash", self.scene, *sizes, *shaders, "--side", side, "--frames", "2"], [0, 2])

    def all(self, is_short):
        self.check()
        if self.case.get("all_verbs") and (not is_short or self.name.endswith(" divergent")):
            for part in (self.one_item, self.recorded, self.pictures):
                part()
        return self


def shipped(folder, name):
    own = root / "shaders" / folder / name
    return own if own.exists() else root / "shaders" / name


def case_scene(case, system):
    """The case's own scene or its system's, a path or the scene itself, with members replaced."""
    scene = case.get("scene", system["scene"])
    replaced = case.get("replaced")
    if replaced and isinstance(scene, str):
        scene = json.loads((root / scene).read_text(encoding="utf-8"))
    return {**scene, **replaced} if replaced else scene


def last_line(text):
    lines = [line for line in text.splitlines() if "ERROR" in line or "runtime error" in line] or text.splitlines()
    return lines[-1][:200] if lines else "nothing on standard error"


def printed_commands(report):
    """The `lockstep ...` commands of a report, as words."""
    return [line.split("lockstep ", 1)[1].split() for line in report.splitlines()
            if re.match(r"^(repeat|explain|capsule|\s+)\s*lockstep (check|explain|capsule|debug) ", line)
            and "debug" not in line]


def run_in_folder(keep, runs):
    """What `runs` gives of an empty folder, which is kept in `keep` or removed."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix="matrix_", dir=keep)) / "run"
    folder.mkdir()
    try:
        return runs(folder)
    finally:
        if not keep:
            shutil.rmtree(folder.parent)


def run_case(program, name, case, system, keep, is_short):
    return run_in_folder(keep, lambda folder: Run(program, name, case, system, folder).all(is_short))


def run_verbs(program, verbs, folder):
    """The verbs that run no scene of a system."""
    run = Run(program, "no system", {}, {"scene": {}, "shaders": ""}, folder)
    for verb in verbs:
        words = verb["run"].replace("ROOT", str(root)).replace("TEXTS", str(here / "texts")).split()
        status = verb["status"]
        text = run.program_run(words, status if isinstance(status, list) else [status])
        run.expect_lines(text, verb.get("lines", []))
    return run


def main():
    options = argparse.ArgumentParser(usage=__doc__)
    options.add_argument("program")
    options.add_argument("--short", action="store_true")
    options.add_argument("--only", default="")
    options.add_argument("--jobs", type=int, default=2)
    options.add_argument("--keep")
    chosen = options.parse_args()
    program = str(pathlib.Path(chosen.program).resolve())
    os.environ.update({"OMP_NUM_THREADS": "1", "LP_NUM_THREADS": "1"})
    os.environ.setdefault("ASAN_OPTIONS", "exitcode=99:detect_leaks=0:abort_on_error=0")
    os.environ.setdefault("UBSAN_OPTIONS", "print_stacktrace=1:halt_on_error=1:exitcode=99")
    if chosen.keep:
        pathlib.Path(chosen.keep).mkdir(parents=True, exist_ok=True)
    data = json.loads((here / "cases.json").read_text(encoding="utf-8"))
    work = [(f"{system} {name}", case, data["systems"][system]) for system in data["systems"]
            for name, case in data["systems"][system]["cases"].items() if chosen.only in f"{system} {name}"]
    count, problems = 0, []
    with concurrent.futures.ThreadPoolExecutor(chosen.jobs) as pool:
        tasks = [pool.submit(run_case, program, *one, chosen.keep, chosen.short) for one in work]
        if chosen.only in "no system":
            tasks.append(pool.submit(run_in_folder, chosen.keep, lambda folder: run_verbs(program, data["verbs"], folder)))
        for task in concurrent.futures.as_completed(tasks):
            run = task.result()
            count += run.count
            problems += run.problems
            print(f"{'FAILED' if run.problems else 'held  '} {run.name}: {run.count} runs, {run.seconds:.0f} s, "
                  f"the longest {run.slowest[0]:.0f} s: {run.slowest[1]}", flush=True)
            for problem in run.problems:
                print("    " + problem, flush=True)
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    print(f"{count} runs of {len(work)} cases, {len(problems)} problems; {used.ru_utime + used.ru_stime:.0f} s of processor time")
    return 1 if problems or not count else 0


sys.exit(main())
