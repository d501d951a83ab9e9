"""Blender Cycles' bake to vertex colours, headless, on the mesh that radvor's uniform bake has. Nothing is divided: Cycles
traces every corner of every triangle, about six for each vertex, and that is what its user waits for."""
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

import runs
from errors import errors

k_sites = 10_000
k_samples = (4, 16, 64, 256)
k_most_seconds = 200  # of one bake: four times the samples take four times as long


def curve(scene, spacing_for):
    if not shutil.which("blender"):
        print("blender is not installed: no curve for Cycles", file=sys.stderr)
        return []
    reference = scene.reference()
    points = []
    with tempfile.TemporaryDirectory() as folder:
        mesh = pathlib.Path(folder) / "mesh.obj"
        spacing = spacing_for(scene, k_sites)
        made = runs.run(["mesh", scene.obj, "--patch-spacing", spacing, "--min-spacing", spacing, "--disable", "refinement",
                         "--element-levels", 0, "--stats", mesh])[0]
        for samples in k_samples:
            values = pathlib.Path(folder) / f"values-{samples}.csv"
            command = ["blender", "--background", "--factory-startup", "--threads", "1", "--python-exit-code", "1"]
            command += ["--python", pathlib.Path(__file__).parent / "cycles_in_blender.py", "--", mesh, reference, values]
            command += [samples, scene.lights or "-"]
            done = subprocess.run([str(word) for word in command], capture_output=True, text=True,
                                  timeout=10 * k_most_seconds)
            if done.returncode != 0:
                print(f"blender: exit code {done.returncode}: {(done.stderr or done.stdout)[-800:]}", file=sys.stderr)
                break
            line = next(line for line in done.stdout.splitlines() if line.startswith("{"))
            points.append({**json.loads(line), **made, "samples": samples, "error": errors(reference, values)})
            if 4 * points[-1]["cpu_seconds"] > k_most_seconds:
                break
    return points
