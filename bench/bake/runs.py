"""Runs bake_bench, one child at a time: a limit on each run, its JSON, and the error of what it wrote."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

from errors import errors, load_values

k_root = pathlib.Path(__file__).resolve().parent.parent.parent
k_shared = pathlib.Path(os.environ.get("RADVOR_SHARED_DIR", k_root.parent / "shared")) / "scenes"
k_own = k_root / "samples/scenes"
k_program = k_root / "build/release/bin/bake_bench"
k_own_points = 4000
k_own_samples = 1 << 14


class Scene:
    """An OBJ with what lies beside it, or a scene that bake_bench makes (city:..., hall:...)."""

    def __init__(self, name, work):
        self.name = name
        self.work = work
        folder = k_shared / name
        if ":" in name:
            self.obj, self.lights, self.folder = name, None, None
        elif folder.is_dir():
            self.obj, self.folder = folder / "scene.obj", folder
            self.lights = folder / "lights.txt" if (folder / "lights.txt").exists() else None
        elif (k_own / f"{name}.obj").exists():
            self.obj, self.lights, self.folder = k_own / f"{name}.obj", None, None
        else:
            sys.exit(f"no scene {name} at {k_shared} or {k_own}")

    def light_arguments(self):
        return ["--lights", self.lights] if self.lights else []

    def reference(self, direct=False):
        """Points with their irradiance; None where the scene came without and is no own one."""
        kind = "reference-direct.csv" if direct else "reference.csv"
        if self.folder:
            return self.folder / kind if (self.folder / kind).exists() else None
        file = self.work / f"{self.name.replace(':', '-')}-{kind}"
        if not file.exists():
            make_reference(self, file, direct)
        return file


def make_reference(scene, file, direct):
    """The path tracer's word at points of our own, twice with different seeds: mean and half their difference."""
    with tempfile.TemporaryDirectory() as folder:
        points = pathlib.Path(folder) / "points.csv"
        run(["points", scene.obj, "--count", k_own_points, "--out", points])
        sides = []
        for seed in (101, 202):
            prefix = pathlib.Path(folder) / f"seed{seed}"
            trace(scene, points, prefix, most_samples=k_own_samples, most_seconds=200, direct=direct, seed=seed)
            newest = max(prefix.parent.glob(f"{prefix.name}-*.csv"), key=lambda f: int(f.stem.split("-")[-1]))
            sides.append([[float(v) for v in line.split(",")[:3]] for line in newest.read_text().split()[1:]])
        lines = points.read_text().split()
        with open(file, "w") as out:
            out.write(lines[0] + ",r,g,b,se\n")
            for line, a, b in zip(lines[1:], *sides):
                mean = [(x + y) / 2 for x, y in zip(a, b)]
                spread = (sum((x - y) ** 2 for x, y in zip(a, b)) / 12) ** 0.5
                out.write(line + "," + ",".join(f"{v:.9g}" for v in mean + [spread]) + "\n")


def run(arguments, seconds=3600, environment=None):
    """Lines of JSON that bake_bench prints. Raises where it fails; what it printed before a limit is kept."""
    command = [str(word) for word in [k_program, *arguments]]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=seconds, env=environment)
        output = done.stdout
        if done.returncode != 0:
            raise RuntimeError(f"{' '.join(command)}: exit code {done.returncode}: {done.stderr.strip()[-500:]}")
    except subprocess.TimeoutExpired as late:
        output = (late.stdout or b"").decode() if isinstance(late.stdout, bytes) else (late.stdout or "")
        output = output[: output.rfind("\n") + 1]
        print(f"  stopped after {seconds:.0f} s: {' '.join(command)}", file=sys.stderr)
    return [json.loads(line) for line in output.splitlines()]


def bake(scene, arguments, most_seconds, direct=False, keep=False):
    """A bake's statistics with its error (keep: with the values too); None where it did not return in ten times its
    limit of processor seconds."""
    reference = scene.reference(direct)
    with tempfile.TemporaryDirectory() as folder:
        command = ["radvor", scene.obj, *scene.light_arguments(), "--max-seconds", most_seconds, *arguments]
        values = pathlib.Path(folder) / "values.csv"
        if reference:
            command += ["--points", reference, "--points-out", values]
        if direct:
            command += ["--disable", "indirect", "--quantity", "direct"]
        lines = run(command, seconds=10 * most_seconds + 60)
        if not lines:
            return None
        result = lines[0]
        result["finished"] = result["result"] not in ("time spent", "cancelled")
        if reference:
            result["error"] = errors(reference, values)
            if keep:
                result["values"] = load_values(values)[0]
        return result


def trace(scene, points, prefix, most_seconds, most_samples=1 << 20, direct=False, seed=1):
    command = ["trace", scene.obj, *scene.light_arguments(), "--points", points, "--prefix", prefix]
    command += ["--max-seconds", most_seconds, "--samples", most_samples, "--seed", seed]
    return run(command + (["--direct"] if direct else []), seconds=20 * most_seconds + 600)


def trace_curve(scene, most_seconds, direct=False):
    """The path tracer at the reference's points: a point of the curve for each doubling of the samples."""
    reference = scene.reference(direct)
    with tempfile.TemporaryDirectory() as folder:
        prefix = pathlib.Path(folder) / "traced"
        curve = trace(scene, reference, prefix, most_seconds, direct=direct)
        for point in curve:
            point["error"] = errors(reference, f"{prefix}-{point['samples']}.csv")
    return curve
