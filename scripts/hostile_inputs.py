#!/usr/bin/env python3
"""Gives the program damaged, forged and odd inputs, and holds what it promises of all of them: an exit status of 0, 1
or 2, no signal, an end in time, one line on standard error where it could not run, nothing that steers a terminal,
nothing left behind, and every input as it was.

Usage: scripts/hostile_inputs.py PROGRAM [--cases N] [--seed S] [--kinds scene,capsule,...] [--keep DIR]
Cases are numbered; one is repeated by its seed and kind. Exit status: 0 all promises kept, 1 not."""

import argparse
import hashlib
import os
import pathlib
import random
import re
import resource
import subprocess
import sys
import tempfile
import time

root = pathlib.Path(__file__).resolve().parent.parent
seconds, memory = 60, 6 << 30
scene = """{"image": [64, 48], "emitters": [{"count": 60, "min": [-0.4, -0.4, -0.4], "max": [0.4, 0.4, 0.4],
"direction": [0, 1, 0], "speed": 0.5}], "constants": {"collision_range": 0.1, "tick": 0.02, "gravity": [0, -1, 0]},
"switches": {"cdt_format": "rgba16f", "cdt_layers": "1"}, "camera": {"eye": [0, 0, 4], "target": [0, 0, 0], "fov_y": 60},
"obstacles": [{"shape": "sphere", "radius": 0.2, "segments": 8}, {"shape": "plane", "size": [1, 1]}]}"""
values = ["0", "-1", "1e308", "1e-320", "99999999999999999999", "null", '"x"', "[]", "{}", "[[[[1]]]]", "true", "16384",
          '"\\u001b[2J\\nverdict   AGREE"', "[" * 60_000, "[" * 200 + "]" * 200, "9" * 4000, "-0.0", "1.5", "2147483648",
          '"' + "x" * 100_000 + '"', "NaN", "3.5e38"]
words = ["\n", "\x1b[2J", "\u202e", "'", '"', "$(id)", "%s%n", "\\", "{}", "\x07", "é", "-", " ", "../", "\x9b", ";", "#"]


def changed_bytes(rng, data):
    """A few bytes of data changed; of every other file also some of it gone or twice."""
    data = bytearray(data)
    kinds = 3 if rng.random() < 0.5 else 6
    for _ in range(rng.randint(1, 4)):
        at = rng.randrange(len(data)) if data else 0
        change = rng.randrange(kinds)
        if change == 0:
            data[at:at + 1] = bytes([rng.randrange(256)])
        elif change == 1 and data:
            data[at] ^= 1 << rng.randrange(8)
        elif change == 2:
            data[at:at + 8] = rng.choice([b"\xff", b"\0"]) * len(data[at:at + 8])
        elif change == 3:
            del data[at:]
        elif change == 4:
            del data[at:at + rng.randrange(64)]
        else:
            data[at:at] = data[at:at + rng.randrange(64)]
    return bytes(data)


def changed_text(rng, text):
    """A value or a word of text in the place of another, a digit for a digit, or changed bytes."""
    if rng.random() < 0.2:
        return changed_bytes(rng, text.encode())
    for _ in range(rng.randint(1, 3)):
        if rng.random() < 0.5:
            digit = rng.choice(list(re.finditer(r"[0-9a-f]", text))).start()
            text = text[:digit] + rng.choice("0123456789") + text[digit + 1:]
            continue
        places = list(re.finditer(r'-?\d[\d.e+-]*|"[^"]*"|\[[^][]*\]', text))
        place = rng.choice(places)
        other = rng.choice(values + [p.group() for p in places[:40]])
        text = text[:place.start()] + other + text[place.end():]
    return text.encode(errors="surrogateescape")


def sealed(data):
    body = data[512:]
    head = f"lockstep trace 1\nbytes {len(data)}\nsha256 {hashlib.sha256(body).hexdigest()}\n".encode()
    return head.ljust(512, b"\0") + body


class Cases:
    """Each method writes the inputs of one case into a folder and gives the arguments."""

    def __init__(self, rng, program, trace):
        self.rng, self.program, self.trace_bytes = rng, program, trace
        self.capsules = [p.read_text() for p in sorted((root / "tests/fuzz/corpus/capsule").iterdir())]

    def scene(self, folder):
        (folder / "scene.json").write_bytes(changed_text(self.rng, scene))
        return ["hash", "scene.json", "--particles", "50", "--every", "--frames", "2"]

    def capsule(self, folder):
        (folder / "capsule.json").write_bytes(changed_text(self.rng, self.rng.choice(self.capsules)))
        return ["capsule", "show", "capsule.json"]

    def trace(self, folder):
        data = changed_bytes(self.rng, self.trace_bytes)
        sealing = self.rng.random() < 0.8 and len(data) > 512
        (folder / "run.h5").write_bytes(sealed(data) if sealing else data)
        return self.rng.choice([["trace", "run.h5"], ["check", "--trace", "run.h5"]])

    def mesh(self, folder):
        rng = self.rng
        obj = "mtllib a.mtl\n" + "".join(f"v {rng.random()} {rng.random()} {rng.random()}\n" for _ in range(30))
        obj += "".join("f " + " ".join(str(rng.randint(1, 30)) for _ in range(rng.randint(3, 5))) + "\n" for _ in range(40))
        ply = "ply\nformat ascii 1.0\nelement vertex 30\nproperty float x\nproperty float y\nproperty float z\n"
        ply += "element face 40\nproperty list uchar int vertex_indices\nend_header\n"
        ply += "".join(f"{rng.random()} {rng.random()} {rng.random()}\n" for _ in range(30))
        ply += "".join("3 " + " ".join(str(rng.randrange(30)) for _ in range(3)) + "\n" for _ in range(40))
        name, text = rng.choice([("a.obj", obj), ("a.ply", ply)])
        if rng.random() < 0.5:
            text = re.sub(r"\d+", lambda m: rng.choice(["-1", "0", "1e308", "nan", "65536", "9" * 30]) if rng.random() < 0.02
                          else m.group(), text)
        (folder / name).write_bytes(changed_bytes(rng, text.encode()) if rng.random() < 0.5 else text.encode())
        os.mkfifo(folder / "a.mtl")
        shape = '[{"shape": "mesh", "file": "%s", "height": 1}]' % name
        (folder / "scene.json").write_text(re.sub(r'"obstacles": .*\]', '"obstacles": ' + shape, scene, flags=re.S))
        return ["hash", "scene.json", "--frames", "2"]

    def name(self, folder):
        rng = self.rng
        name = "".join(rng.choice(words) for _ in range(rng.randint(1, 6))).replace("/", "")
        raw = os.fsencode(name) + rng.choice([b"", b"\xff", b"\xc3"])
        kind = rng.randrange(6)
        path = os.path.join(os.fsencode(folder), raw + b".json")
        if kind == 0:
            pathlib.Path(os.fsdecode(path)).write_text(scene)
        elif kind == 1:
            os.mkdir(path)
        elif kind == 2:
            os.symlink(path, path)
        elif kind == 3:
            os.symlink(rng.choice(["/dev/null", "/dev/zero", "/dev/full", "/proc/self/mem"]), path)
        path = os.fsdecode(os.path.join(b".", raw + b".json"))
        verb = rng.choice([["hash", path, "--frames", "1"], ["check", "--trace", path], ["trace", path],
                           ["capsule", "show", path], ["hash", path, "--frames", "1", "--preset", name]])
        return verb

    def option(self, folder):
        rng = self.rng
        (folder / "scene.json").write_text(scene)
        key = rng.choice(["tick", "gravity", "cdt_layers", "speed_factor", "octree_size", "texel_collide_range", "x",
                          "base_texel", "", "cdt_camera_offset"])
        value = rng.choice(values + words)
        return ["hash", "scene.json", "--frames", "2", "--set", f"{key}={value[:100_000]}"]

    def shader(self, folder):
        rng = self.rng
        (folder / "scene.json").write_text(scene)
        (folder / "mine").mkdir()
        name = rng.choice(["collision_pass.vert", "collision_pass.frag", "collision_pass.geom"])
        text = (root / "shaders/collision" / name).read_text()
        change = rng.randrange(4)
        if change == 0:
            data = changed_bytes(rng, text.encode())
        elif change == 1:
            data = re.sub(r"#version[^\n]*", "#version " + rng.choice(["120", "300 es", "100", "999", "x", ""]), text).encode()
        elif change == 2:
            data = (text + "//" + "x" * 200_000 + "\n").encode()
        else:
            spaced = text.replace(" ", rng.choice(["  ", "\t", " /* */ "]))
            data = rng.choice([b"\xef\xbb\xbf", b"\xff\xfe", b"", b"\n"]) + spaced.encode()
        (folder / "mine" / name).write_bytes(data)
        return ["check", "scene.json", "--frames", "2", "--gl", "osmesa", "--shaders", "mine"]


def contents(folder):
    """What lies in a folder, with the bytes of regular files."""
    return {p.name: p.read_bytes() if p.is_file() and not p.is_symlink() else b"" for p in folder.rglob("*")}


def broken_promises(program, arguments, folder):
    before, limit = contents(folder), lambda: resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
    start = time.monotonic()
    try:
        run = subprocess.run([program] + arguments, cwd=folder, capture_output=True, timeout=seconds, preexec_fn=limit,
                             stdin=subprocess.DEVNULL)
    except subprocess.TimeoutExpired:
        return [f"no end after {seconds} s"], None
    broken = []
    if run.returncode not in (0, 1, 2):
        broken.append(f"status {run.returncode}: {run.stderr[:300]!r}")
    lines = run.stderr.split(b"\n")
    if run.returncode == 2 and (len(lines) != 2 or not lines[0].startswith(b"lockstep: ") or run.stdout):
        broken.append(f"not one line of error: {run.stderr[:300]!r} {run.stdout[:300]!r}")
    if run.returncode == 1 and not re.search(rb"DIVERGENT|DIFFER|UNDEFINED|NONDETERMINISTIC", run.stdout):
        broken.append(f"status 1 without a verdict: {run.stdout[:300]!r}")
    odd = re.search(rb"[\x00-\x08\x0b-\x1f\x7f]|\xe2\x80\xae|\xc2[\x80-\x9f]", run.stdout + run.stderr.replace(b"\r\x1b[K", b""))
    if odd:
        broken.append(f"steers the terminal: {odd.group()!r}")
    if len(run.stderr) > 10_000 and run.returncode == 2:
        broken.append(f"an error of {len(run.stderr)} bytes")
    if contents(folder) != before:
        broken.append(f"left or changed: {sorted(set(contents(folder)) ^ set(before))}")
    if time.monotonic() - start > seconds / 2:
        broken.append(f"took {time.monotonic() - start:.0f} s")
    return broken, run.returncode


def recorded(program):
    """A small trace, or nothing where there is no OSMesa."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "scene.json").write_text(scene)
        run = subprocess.run([program, "record", "scene.json", "--frames", "3", "--cdt", "--gl", "osmesa", "-o", "run.h5"],
                             cwd=folder, capture_output=True)
        return (folder / "run.h5").read_bytes() if run.returncode == 0 else None


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=lambda p: str(pathlib.Path(p).resolve()))
    parser.add_argument("--cases", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--kinds", default="scene,capsule,trace,mesh,name,option,shader")
    parser.add_argument("--keep", type=pathlib.Path, help="keeps the inputs of broken promises here")
    options = parser.parse_args()
    trace = recorded(options.program)
    kinds = [k for k in options.kinds.split(",") if trace or k not in ("trace", "shader")]
    told, failed = {}, 0
    for number in range(options.cases):
        kind = kinds[number % len(kinds)]
        case = options.seed * 1_000_000 + number
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            arguments = getattr(Cases(random.Random(case), options.program, trace), kind)(folder)
            broken, status = broken_promises(options.program, arguments, folder)
            told.setdefault(kind, []).append(status)
            if broken:
                failed += 1
                print(f"case {case} ({kind}): {[a[:80] for a in arguments]}: {'; '.join(broken)}", flush=True)
                if options.keep:
                    subprocess.run(["cp", "-r", name, options.keep / str(case)], check=False)
    for kind, statuses in told.items():
        print(f"{kind:<8} {len(statuses)} cases: " + ", ".join(f"{statuses.count(s)} of status {s}" for s in sorted(set(statuses), key=str)))
    print(f"{options.cases} cases, {failed} broken promises")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
