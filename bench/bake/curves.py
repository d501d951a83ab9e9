"""Run time against error: radvor at many tolerances, its uniform mesh, and the path tracer, on one scene after the other."""
import math
import statistics

import cycles
import plots
import runs
from errors import cost_at

k_tolerances = (0.3, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002)
k_uniform_sites = (2_000, 8_000, 32_000, 128_000)
k_uniform_levels = 2
k_skips = ("facing", "negligible", "lazy", "clear-shafts")
k_tracer_points = 10_000
# A closed box without clutter is judged by all of its points; scans and models keep their worst 1 % out.
k_figures = {"cornell": "rms"}


def spacing_for(scene, sites):
    """Of hexagonal elements that are so many on the scene's area."""
    area = runs.run(["describe", scene.obj])[0]["area"]
    return math.sqrt(area / sites * 2 / math.sqrt(3))


def steady_bake(scene, arguments, most_seconds):
    """A bake; one of less than a second three times, with the median of their processor times."""
    result = runs.bake(scene, arguments, most_seconds)
    if result is not None and result["cpu_seconds"] < 1:
        times = [result["cpu_seconds"]]
        times += [runs.bake(scene, arguments, most_seconds)["cpu_seconds"] for _ in range(2)]
        result["cpu_seconds"] = statistics.median(times)
    return result


def radvor_curve(scene, most_seconds, threads):
    curve = []
    for tolerance in k_tolerances:
        result = steady_bake(scene, ["--tolerance", tolerance, "--threads", threads], most_seconds)
        if result is None:
            break
        curve.append({**result, "tolerance": tolerance})
        say(scene, f"radvor {tolerance}", curve[-1])
        if not result["finished"]:
            break  # the next one would not either
    return curve


def uniform_curve(scene, most_seconds, threads):
    curve = []
    disable = ",".join(("refinement", *k_skips))
    for sites in k_uniform_sites:
        spacing = spacing_for(scene, sites)
        arguments = ["--patch-spacing", spacing * 2**k_uniform_levels, "--min-spacing", spacing]
        arguments += ["--element-levels", k_uniform_levels, "--disable", disable, "--threads", threads]
        result = steady_bake(scene, arguments, most_seconds)
        if result is None:
            break
        curve.append({**result, "spacing": spacing})
        say(scene, f"uniform {sites}", curve[-1])
        if not result["finished"]:
            break
    return curve


def say(scene, what, result):
    error = result.get("error")
    words = f"rms {100 * error['rms']:.2f} %  rms99 {100 * error['rms99']:.2f} %  local {100 * error['local']:.1f} %  " if error else ""
    words += f"{result['cpu_seconds']:.2f} s"
    if "sites" in result:
        words += f"  {result['sites']:,} sites  {result['rays'] / 1e6:.2f} M rays"
    if not result.get("finished", True):
        words += "  TIME SPENT"
    print(f"{scene.name:<12} {what:<18} {words}", flush=True)


def measure(scene, options):
    """All curves of a scene. The tracer's seconds are for k_tracer_points points: its cost is linear in them."""
    curves = {}
    if "radvor" in options.only:
        curves["radvor"] = radvor_curve(scene, options.max_seconds, 1)
    if "uniform" in options.only:
        curves["uniform"] = uniform_curve(scene, options.max_seconds, 1)
    if "tracer" in options.only:
        curve = runs.trace_curve(scene, options.tracer_seconds)
        for point in curve:
            point["cpu_seconds_as_run"] = point["cpu_seconds"]
            point["cpu_seconds"] *= k_tracer_points / point["points"]
            say(scene, f"tracer {point['samples']}", point)
        curves["tracer"] = curve
    if options.cycles:
        curves["cycles"] = cycles.curve(scene, spacing_for)
        for point in curves["cycles"]:
            say(scene, f"cycles {point['samples']}", point)
    return curves


def summary(name, curves):
    """Seconds to 5, 3, 2 and 1 % error, and how many times more the tracer takes: at k_tracer_points points, and at as many
    receivers as radvor had."""
    figure = k_figures.get(name, "rms99")
    rows = []
    for error in (0.05, 0.03, 0.02, 0.01):
        row = {"figure": figure, "error": error}
        for method, curve in curves.items():
            told = [r for r in curve if r.get("error")]
            row[method] = cost_at(told, figure, error)
            if method in ("radvor", "uniform"):
                row[method + "_rays"] = cost_at(told, figure, error, "rays")
        receivers = cost_at([r for r in curves.get("radvor", []) if r.get("error")], figure, error, "sites")
        if receivers and row.get("tracer"):
            row["radvor_sites"] = receivers
            row["times_tracer"] = row["tracer"] / row["radvor"]
            row["times_tracer_at_equal_receivers"] = row["times_tracer"] * receivers / k_tracer_points
        rows.append(row)
    return rows


def draw(name, curves, folder):
    plots.draw(name, k_figures.get(name, "rms99"), curves, k_tracer_points, folder / f"performance-{name}.png")
