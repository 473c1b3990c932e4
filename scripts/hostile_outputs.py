#!/usr/bin/env python3
"""Gives the program odd places for its outputs, small limits and signals, and holds what it promises of all of them: an
exit status of 0 or 2 (or the signal that was sent), one line on standard error where it could not run, every input and
every file from before as it was unless the run succeeded, all outputs or none, and no temporary file or new folder left.

Usage: scripts/hostile_outputs.py PROGRAM [--gl osmesa]
Exit status: 0 all promises kept, 1 not."""

import argparse
import itertools
import os
import pathlib
import resource
import signal
import stat
import subprocess
import sys
import tempfile
import time

scene = """{"constants": {"collision_range": 0.1}, "image": [64, 48], "render": [40, 30], "emitters": [{"count": 300,
"min": [-0.4, -0.4, -0.4], "max": [0.4, 0.4, 0.4], "speed": 0.5}], "obstacles": [{"shape": "plane", "size": [1, 1]}]}"""

files = {"check --json": ["check", "SCENE", "GL", "--frames", "2", "--json", "OUT"],
         "check --hashes": ["check", "SCENE", "GL", "--frames", "2", "--hashes", "OUT"],
         "record": ["record", "SCENE", "GL", "--frames", "2", "-o", "OUT"],
         "render": ["render", "SCENE", "-o", "OUT"],
         "capsule": ["capsule", "cut", "SCENE", "GL", "--frame", "1", "--particle", "3", "-o", "OUT"],
         "study --csv": ["study", "SCENE", "--frames", "2", "--csv", "OUT"],
         "study --json": ["study", "SCENE", "--frames", "2", "--json", "OUT"],
         "probe": ["probe", "GL", "--inputs", "64", "--json", "OUT"]}
folders = {"check --images": ["check", "SCENE", "GL", "--frames", "2", "--images", "OUT"],
           "check --report": ["check", "SCENE", "GL", "--frames", "2", "--report", "OUT"],
           "study --images": ["study", "SCENE", "--frames", "3", "--images", "OUT"]}


def place(kind, folder):
    """Makes what the kind is, and gives the name to write to."""
    out, other = folder / "out", folder / "other"
    if kind == "a file from before":
        out.write_text("before")
    elif kind == "a folder":
        out.mkdir()
    elif kind == "a full folder":
        out.mkdir()
        (out / "lockstep").mkdir()
    elif kind == "in a missing folder":
        out = out / "deep" / "er"
    elif kind == "in a file":
        out.write_text("before")
        out = out / "deep"
    elif kind == "the scene":
        out = folder / "scene.json"
    elif kind in ("a link to the scene", "a link to nothing", "a link to itself", "a link to a full device"):
        out.symlink_to({"a link to the scene": "scene.json", "a link to nothing": "other", "a link to itself": "out",
                        "a link to a full device": "/dev/full"}[kind])
    elif kind == "a hard link to the scene":
        os.link(folder / "scene.json", out)
    elif kind == "a linked folder":
        other.mkdir()
        out.symlink_to("other")
    elif kind == "a socket":
        os.mknod(out, 0o600 | stat.S_IFSOCK)
    elif kind in ("/dev/null", "/dev/full", "/dev/stdout", "/proc/out", "/sys/out", "-", ""):
        return kind
    elif kind == "a long name":
        out = folder / ("n" * 255)
    elif kind == "a name too long":
        out = folder / ("n" * 256)
    elif kind == "a path too long":
        return str(folder) + "/x" * 3000
    elif kind == "an odd name":
        return os.fsencode(folder) + b"/'\n\x1b[2J\xff $(id) -"
    elif kind == "a dash first":
        return "-out"
    return str(out)


kinds = ["new", "a file from before", "a folder", "a full folder", "in a missing folder", "in a file", "the scene",
         "a link to the scene", "a link to nothing", "a link to itself", "a link to a full device",
         "a hard link to the scene", "a linked folder", "a socket", "/dev/null", "/dev/full", "/dev/stdout", "/proc/out",
         "/sys/out", "-", "", "a long name", "a name too long", "a path too long", "an odd name", "a dash first"]


def seen(folder):
    return {path.relative_to(folder): path.read_bytes() if path.is_file() else "" for path in folder.rglob("*")}


class Case:
    def __init__(self, program, gl, name, arguments, kind):
        self.name, self.broken, self.temporary = f"{name}, {kind}", [], tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)
        (self.folder / "scene.json").write_text(scene)
        self.out = place(kind, self.folder)
        words = {"SCENE": ["scene.json"], "GL": ["--gl", gl], "OUT": [self.out]}
        self.command = [program] + list(itertools.chain(*(words.get(word, [word]) for word in arguments)))
        self.before = seen(self.folder)

    def start(self, limits=(), **options):
        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_DFL)
            for what, value in limits:
                resource.setrlimit(what, (value, value))
        environment = dict(os.environ, MESA_SHADER_CACHE_DISABLE="true")
        return subprocess.Popen(self.command, cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, preexec_fn=limit, env=environment, **options)

    def hold(self, kept, what):
        if not kept:
            self.broken.append(what)

    def judge(self, process, sent=None):
        try:
            err = process.communicate(timeout=120)[1]
        except subprocess.TimeoutExpired:
            process.kill()
            err = process.communicate()[1]
            self.hold(False, "no end")
        status, after = process.returncode, seen(self.folder)
        self.hold(status in (0, 2) or (sent is not None and status in (-sent, 130)), f"exit status {status}")
        self.hold(status != 2 or (err.count(b"\n") == 1 and err.startswith(b"lockstep: ")), f"said {err!r}")
        self.hold(status in (0, 130) or after == self.before, f"left {sorted(map(str, set(after) ^ set(self.before)))}")
        self.hold(not [path for path in after if path.name.endswith(".part")], "a temporary file")
        self.hold(after[pathlib.Path("scene.json")] == scene.encode(), "the scene is another")
        self.hold(status != 0 or sent or not isinstance(self.out, str) or os.path.exists(self.folder / self.out),
                  "nothing written")
        print("kept  " if not self.broken else "BROKEN", repr(self.name), *self.broken, flush=True)
        self.temporary.cleanup()
        return not self.broken


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--gl", default="osmesa")
    options = parser.parse_args()
    program = str(pathlib.Path(options.program).resolve())
    kept = []
    for (name, arguments), kind in itertools.product({**files, **folders}.items(), kinds):
        if "scene" in kind and "SCENE" not in arguments:
            continue
        case = Case(program, options.gl, name, arguments, kind)
        kept.append(case.judge(case.start()))
    for (name, arguments), size in itertools.product({**files, **folders}.items(), (0, 1, 1000, 20_000)):
        case = Case(program, options.gl, f"{name}, at most {size} bytes", arguments, "a file from before"
                    if name in files else "new")
        kept.append(case.judge(case.start([(resource.RLIMIT_FSIZE, size)])))
    endings = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT, signal.SIGXCPU, signal.SIGSEGV)
    longer = [("record", files["record"]), *folders.items()]
    for (name, arguments), ending, wait in itertools.product(longer, endings, (0.1, 0.4, 1.0, 2.0)):
        arguments = [word if word not in "23" else "100000000" for word in arguments]
        case = Case(program, options.gl, f"{name}, {ending.name} after {wait} s", arguments, "new")
        process = case.start()
        time.sleep(wait)
        process.send_signal(ending)
        if ending == signal.SIGINT:
            time.sleep(0.5)
            process.send_signal(ending)
        kept.append(case.judge(process, ending))
    print(f"{len(kept)} cases, {kept.count(False)} broken")
    return 0 if all(kept) else 1


if __name__ == "__main__":
    sys.exit(main())
