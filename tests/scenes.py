#!/usr/bin/env python3
"""Bakes real scenes with radvor-bake and compares the light with path-traced references.

    scenes.py [SCENE...] [--direct] [--json OUT] [--keep DIR] [-- RADVOR-BAKE ARGUMENT...]

SCENE      folders of ../shared/scenes: scene.obj, lights.txt and reference.csv, the latter two where they exist [all]
--direct   direct light alone, against reference-direct.csv
--json     everything measured, and the statistics of each bake
--keep     what each bake wrote, and a picture: SCENE.csv, .json, .log, .ply, .png
--bake     the program [build/release/bin/radvor-bake]
--torn-edges   the program [torn_edges beside radvor-bake]: are the meshes that come out whole?
--shared   the folder that holds scenes/ [$RADVOR_SHARED_DIR, else ../shared]
--         what follows goes to radvor-bake as it is

The errors are those of compare.py, which lies beside the scenes. Fails where a bake crashes, takes more than ten minutes
or 8 GiB, gives a value that is not finite, misses a bound of k_bounds, or gives a mesh that is torn where the scene is
not (a T-vertex, a gap). Exits with 77 where the scenes are absent.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

k_root = pathlib.Path(__file__).resolve().parent.parent
k_skipped = 77
k_most_seconds = 600
k_most_bytes = 8 << 30

# What a scene is baked with beyond the defaults.
k_arguments = {}

# The largest errors for a scene to pass, at default options.
k_bounds = {
    "cornell": {"rms": 0.015, "local": 0.02},
    "gazebo": {"rms": 0.03},
    "kenney-fps": {"rms99": 0.02, "local": 0.1},
    "living-room": {"rms99": 0.05, "local": 0.15},
    "staircase": {"rms99": 0.05},
}

k_columns = [  # heading, key, how it is written
    ("rms", "rms", lambda v: f"{100 * v:.2f} %"),
    ("rms99", "rms99", lambda v: f"{100 * v:.2f} %"),
    ("local", "local", lambda v: f"{100 * v:.2f} %"),
    ("bias", "bias", lambda v: f"{100 * v:+.2f} %"),
    ("p95", "p95", lambda v: f"{100 * v:.2f} %"),
    ("lost", "lost", lambda v: f"{100 * v:.2f} %"),
    ("sites", "sites", lambda v: f"{v:,}"),
    ("rays", "rays", lambda v: f"{v / 1e6:,.1f} M"),
    ("seconds", "seconds", lambda v: f"{v:.1f}"),
    ("peak", "peak_bytes", lambda v: f"{v / 1e6:,.0f} MB"),
]


def parse_arguments():
    own, bake = sys.argv[1:], []
    if "--" in own:
        at = own.index("--")
        own, bake = own[:at], own[at + 1 :]
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*")
    parser.add_argument("--direct", action="store_true")
    parser.add_argument("--json", type=pathlib.Path)
    parser.add_argument("--keep", type=pathlib.Path)
    parser.add_argument("--bake", type=pathlib.Path, default=k_root / "build/release/bin/radvor-bake")
    parser.add_argument("--torn-edges", type=pathlib.Path)
    parser.add_argument(
        "--shared", type=pathlib.Path, default=os.environ.get("RADVOR_SHARED_DIR", k_root.parent / "shared")
    )
    options = parser.parse_args(own)
    options.torn_edges = options.torn_edges or options.bake.parent / "torn_edges"
    return options, bake


def run(command, log):
    """Exit code (negative: the signal), seconds and largest resident size of a program."""
    begin = time.monotonic()
    with open(log, "wb") as output:
        process = subprocess.Popen(command, stdout=output, stderr=subprocess.STDOUT)
        while True:
            pid, status, usage = os.wait4(process.pid, os.WNOHANG)
            seconds = time.monotonic() - begin
            if pid:
                return os.waitstatus_to_exitcode(status), seconds, usage.ru_maxrss * 1024
            if seconds > k_most_seconds + 60:  # the program was told the limit, and ignores it
                process.kill()
            time.sleep(0.05)


def bake(scene, options, bake_arguments, folder):
    """What was measured, and what is wrong (a list of words)."""
    name = scene.name
    points = scene / ("reference-direct.csv" if options.direct else "reference.csv")
    mesh = folder / f"{name}.ply"
    command = [options.bake, scene / "scene.obj", "--stats", folder / f"{name}.json", "-o", mesh]
    command += k_arguments.get(name, [])
    if (scene / "lights.txt").exists():
        command += ["--lights", scene / "lights.txt"]
    if options.direct:
        command += ["--disable", "indirect", "--quantity", "direct"]
    if points.exists():
        command += ["--points", points, "--points-out", folder / f"{name}.csv"]
    if options.keep:
        command += ["--preview", folder / f"{name}.png"]
    command += bake_arguments
    code, seconds, resident = run([str(word) for word in command], folder / f"{name}.log")
    if code != 0:
        tail = (folder / f"{name}.log").read_text(errors="replace").strip().splitlines()[-3:]
        return {"exit": code}, [f"radvor-bake exits with {code}: " + " / ".join(tail)]
    result = json.loads((folder / f"{name}.json").read_text())
    result["resident_bytes"] = resident
    wrong = []
    if points.exists():
        compare = subprocess.run(
            [sys.executable, scene.parent / "compare.py", points, folder / f"{name}.csv", "--json"],
            capture_output=True,
            text=True,
        )
        if compare.returncode != 0:
            wrong.append((compare.stderr or compare.stdout).strip())
        else:
            result["error"] = json.loads(compare.stdout)
            for figure, bound in k_bounds.get(name, {}).items():
                if not options.direct and not bake_arguments and result["error"][figure] > bound:
                    wrong.append(f"{figure} {100 * result['error'][figure]:.2f} % is more than {100 * bound:g} %")
    torn = subprocess.run([options.torn_edges, scene / "scene.obj", mesh], capture_output=True, text=True)
    if torn.returncode != 0:
        wrong.append((torn.stderr or torn.stdout).strip())
    if seconds > k_most_seconds:
        wrong.append(f"{seconds:.0f} s are more than {k_most_seconds} s")
    if max(resident, result["peak_bytes"]) > k_most_bytes:
        wrong.append(f"{max(resident, result['peak_bytes']) / 2**30:.1f} GiB are more than {k_most_bytes >> 30} GiB")
    return result, wrong


def row(name, result):
    values = {**result, **result.get("error", {})}
    cells = [write(values[key]) if key in values else "-" for _, key, write in k_columns]
    return f"{name:<18}" + "".join(f"{cell:>12}" for cell in cells)


def main():
    options, bake_arguments = parse_arguments()
    scenes = pathlib.Path(options.shared) / "scenes"
    if not scenes.is_dir():
        print(f"SKIPPED: there are no scenes at {scenes}", file=sys.stderr)
        sys.exit(k_skipped)
    names = options.scenes or sorted(folder.name for folder in scenes.iterdir() if (folder / "scene.obj").exists())
    unknown = [name for name in names if not (scenes / name / "scene.obj").exists()]
    if unknown:
        sys.exit(f"no scene {', '.join(unknown)} at {scenes}")
    for program in (options.bake, options.torn_edges):
        if not program.exists():
            sys.exit(f"{program} is not there: ./dev build")

    results, failed = {}, False
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.keep or pathlib.Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        print(f"{'':<18}" + "".join(f"{heading:>12}" for heading, _, _ in k_columns), flush=True)
        for name in names:
            results[name], wrong = bake(scenes / name, options, bake_arguments, folder)
            print(row(name, results[name]), flush=True)
            for words in wrong:
                print(f"{'':<18}FAILED: {words}", flush=True)
            results[name]["wrong"] = wrong
            failed = failed or bool(wrong)
    if options.json:
        options.json.write_text(json.dumps(results, indent=2) + "\n")
    sys.exit(1 if failed else 0)


main()
