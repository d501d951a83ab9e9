#!/usr/bin/env python3
"""Run time against error of whole bakes.

    ./dev bench bake [SCENE...]            curves: radvor, its uniform mesh, a path tracer beside them
    ./dev bench bake STUDY [SCENE...]      skips, threads, scaling, embree, first-light, city,
                                           lattices, halving, tracer

SCENE is a folder of ../shared/scenes or a file of samples/scenes without its .obj [the clean scenes with a reference].
Figures go to build/bench/bake.json (--json), pictures to build/bench (--pictures). Errors are those of
../shared/scenes/compare.py. Seconds are processor seconds of all threads, so that a busy machine matters less."""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile

k_root = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(k_root / "bench/bake"))

import curves  # noqa: E402
import errors  # noqa: E402
import runs  # noqa: E402
import studies  # noqa: E402

k_clean = ("cornell", "kenney-fps", "staircase", "living-room")


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("words", nargs="*", metavar="[STUDY] [SCENE...]")
    parser.add_argument("--only", default="radvor,uniform,tracer", help="curves to measure, of radvor,uniform,tracer")
    parser.add_argument("--cycles", action="store_true", help="Blender Cycles' vertex bake as well, where blender is installed")
    parser.add_argument("--max-seconds", type=float, default=60, help="processor seconds of one bake")
    parser.add_argument("--tracer-seconds", type=float, default=10, help="no doubling of samples begins after that")
    parser.add_argument("--tolerance", type=float, default=0.02, help="of the studies")
    parser.add_argument("--seeds", type=int, default=32, help="of skips, 3 at least: bakes with each skip off, and as many with it")
    parser.add_argument("--off", default=",".join(curves.k_skips), help="of skips: those that are turned off, each by itself")
    parser.add_argument("--slice", type=float, default=0.05, help="of first-light")
    parser.add_argument("--triangles", type=int, default=1_000_000, help="of the city")
    parser.add_argument("--json", type=pathlib.Path, default=k_root / "build/bench/bake.json")
    parser.add_argument("--pictures", type=pathlib.Path, default=k_root / "build/bench")
    options = parser.parse_args()
    options.only = options.only.split(",")
    options.off = options.off.split(",")
    if options.seeds < 3:
        parser.error("--seeds: 3 at least, or there is no standard error")
    return options


def machine():
    model = next((line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")), "?")
    version = subprocess.run(["git", "-C", k_root, "describe", "--always"], capture_output=True, text=True).stdout.strip()
    return {"processor": model, "cores": os.cpu_count(), "version": version}


def check_definitions(scene, work):
    """Our error figures must be compare.py's."""
    compare = runs.k_shared / "compare.py"
    reference = scene.reference()
    if not compare.exists() or not reference:
        return
    values = work / "check.csv"
    irradiance, _ = errors.load_reference(reference)
    with open(values, "w") as out:
        out.write("r,g,b,found\n")
        for i, (r, g, b) in enumerate(irradiance):
            out.write(f"{r * 1.1},{g * 0.9},{b + 0.01 * (i % 7)},{int(i % 50 > 0)}\n")
    theirs = json.loads(subprocess.run([sys.executable, compare, reference, values, "--json"], capture_output=True,
                                       text=True, check=True).stdout)
    ours = errors.errors(reference, values)
    for figure, value in theirs.items():
        if abs(ours[figure] - value) > 1e-9 * max(1, abs(value)):
            sys.exit(f"{figure}: {ours[figure]} here, {value} by {compare}")


def merge(file, part):
    """What was measured before stays in the file until it is measured anew."""
    file.parent.mkdir(parents=True, exist_ok=True)
    whole = json.loads(file.read_text()) if file.exists() else {}
    for key, value in part.items():
        if isinstance(value, dict) and isinstance(whole.get(key), dict):
            whole[key].update(value)
        else:
            whole[key] = value
    file.write_text(json.dumps(whole, indent=1) + "\n")


def main():
    options = parse_arguments()
    study = studies.k_studies.get(options.words[0]) if options.words else None
    names = options.words[1:] if study else options.words
    if not names:
        names = k_clean if runs.k_shared.is_dir() else sorted(f.stem for f in runs.k_own.glob("*.obj"))
    with tempfile.TemporaryDirectory() as work:
        options.work = pathlib.Path(work)
        scenes = [runs.Scene(name, options.work) for name in names]
        check_definitions(scenes[0], options.work)
        if study:
            merge(options.json, {"machine": machine(), options.words[0]: study(scenes, options)})
            return
        for scene in scenes:
            before = json.loads(options.json.read_text()) if options.json.exists() else {}
            measured = {**before.get("curves", {}).get(scene.name, {}), **curves.measure(scene, options)}
            rows = curves.summary(scene.name, measured)
            for row in rows:
                print("  ".join(f"{k} {v:.3g}" if isinstance(v, float) else f"{k} {v}" for k, v in row.items()), flush=True)
            merge(options.json, {"machine": machine(), "curves": {scene.name: measured}, "summary": {scene.name: rows}})
            options.pictures.mkdir(parents=True, exist_ok=True)
            curves.draw(scene.name, measured, options.pictures)


main()
