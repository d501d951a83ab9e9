"""What the curves do not tell: threads, growth, the share of ray casting, first light, and a city of a million triangles;
skips have a file of their own. Every study prints as it goes and returns what goes into the JSON."""
import concurrent.futures
import math
import os
import pathlib
import tempfile

import curves
import runs
from errors import errors, load_reference
from skips import skips

k_city_lights = ["--light", "sky 1 1.2 1.5", "--light", "sun 0.4 -1 0.3 6 5.6 5"]


def say(*words):
    print(*words, flush=True)


def threads(scenes, options):
    """Wall-clock seconds of 1 and 2 threads, the best of three, and of two bakes side by side on one thread each: no
    bake gains more by a second thread than the machine by a second process. It has to be idle for this one."""
    result = {}
    for scene in scenes:
        def wall(count, scene=scene):
            run = runs.bake(scene, ["--tolerance", options.tolerance, "--threads", count], options.max_seconds)
            return run if run is not None and run["finished"] else None

        best, beside = {}, math.inf
        for count in (1, 2) * 3:
            run = wall(count)
            if run is None:
                break
            if count not in best or run["seconds"] < best[count]["seconds"]:
                best[count] = run
            if count == 2:
                with concurrent.futures.ThreadPoolExecutor(2) as pool:
                    both = list(pool.map(wall, (1, 1)))
                beside = min(beside, max(run["seconds"] if run else math.inf for run in both))
        if len(best) == 2:
            speed = best[1]["seconds"] / best[2]["seconds"]
            bound = 2 * best[1]["seconds"] / beside
            overhead = best[2]["cpu_seconds"] / best[1]["cpu_seconds"]
            result[scene.name] = {"seconds": {k: v["seconds"] for k, v in best.items()}, "speed": speed, "bound": bound,
                                  "cpu_seconds_of_two_over_one": overhead, "load": os.getloadavg()[0]}
            say(f"{scene.name:<12} 1 thread {best[1]['seconds']:.2f} s, 2 threads {best[2]['seconds']:.2f} s: "
                f"{speed:.2f} times; two bakes side by side {bound:.2f} times; processor time {overhead:.2f} times; "
                f"load {os.getloadavg()[0]:.1f}")
    return result


def growth(name, count_of, series, options):
    """Exponents between neighbours of a series of (scene, arguments)."""
    rows = []
    for scene, arguments in series:
        run = runs.bake(scene, ["--tolerance", options.tolerance, "--threads", 1, *arguments], options.max_seconds)
        if run is None or not run["finished"]:
            say(f"{name:<12} {scene.name}: no answer in {options.max_seconds:.0f} s")
            break
        rows.append({"count": count_of(scene, run), "cpu_seconds": run["cpu_seconds"], "rays": run["rays"],
                     "sites": run["sites"], "peak_bytes": run["peak_bytes"]})
        words = f"{name:<12} {rows[-1]['count']:>9,}  {run['cpu_seconds']:.2f} s  {run['sites']:,} sites"
        if len(rows) > 1:
            a, b = rows[-2], rows[-1]
            b["exponent"] = math.log(b["cpu_seconds"] / a["cpu_seconds"]) / math.log(b["count"] / a["count"])
            words += f"  exponent {b['exponent']:.2f}"
        say(words)
    return rows


def scaling(scenes, options):
    work = options.work
    receivers = []
    for scene in scenes[:1]:
        for sites in (4_000, 16_000, 64_000):
            spacing = curves.spacing_for(scene, sites)
            receivers.append((scene, ["--patch-spacing", spacing * 4, "--min-spacing", spacing, "--element-levels", 2,
                                      "--disable", "refinement"]))
    halls = [(runs.Scene(f"hall:2:{cells}", work), []) for cells in (25, 50, 100, 200)]
    lamps = [(runs.Scene(f"hall:{count}:25", work), []) for count in (2, 4, 8, 16)]
    for scene, _ in halls + lamps:
        scene.reference = lambda direct=False: None
    return {
        "receivers": growth("receivers", lambda scene, run: run["sites"], receivers, options),
        "triangles": growth("triangles", lambda scene, run: run["input_triangles"], halls, options),
        "lamps": growth("lamps", lambda scene, run: int(scene.name.split(":")[1]) ** 2, lamps, options),
    }


def embree(scenes, options):
    """All-in time over that of the same rays in a bare loop."""
    result = {}
    for scene in scenes:
        lines = runs.run(["replay", scene.obj, *scene.light_arguments(), "--tolerance", options.tolerance,
                          "--max-seconds", options.max_seconds], seconds=8 * options.max_seconds + 60)
        if not lines:
            continue
        row = lines[0]
        row["share_of_rays"] = row["bare_loop_cpu_seconds"] / row["cpu_seconds"]
        row["share_of_build"] = row["build_cpu_seconds"] / row["cpu_seconds"]
        if row["bare_loop_cpu_seconds"] > 0:
            row["bare_rays_per_second"] = row["rays"] / row["bare_loop_cpu_seconds"]
        result[scene.name] = row
        say(f"{scene.name:<12} {row['cpu_seconds']:.2f} s all in, {row['rays'] / 1e6:.2f} M rays: bare loop "
            f"{row['bare_loop_cpu_seconds']:.2f} s, {100 * row['share_of_rays']:.0f} %; "
            f"{row.get('bare_rays_per_second', 0) / 1e6:.1f} M rays/s; tree {100 * row['share_of_build']:.0f} %")
    return result


def first_light(scenes, options):
    """Direct light in slices: what each took, and its error after each: at random points, which the mesh must have
    followed, and at the scene's own vertices, the first second in slices a fifth as long. And how long the slices of
    a whole bake take."""
    result = {}
    for scene in scenes:
        reference = scene.reference(direct=True)
        bake = [scene.obj, *scene.light_arguments(), "--tolerance", options.tolerance]
        in_slices = ["slices", options.slice, *bake]
        with tempfile.TemporaryDirectory() as folder:
            direct = runs.run(in_slices + ["--max-seconds", 10, "--quantity", "direct", "--points", reference,
                                           "--points-out", pathlib.Path(folder) / "values"], seconds=1200)
            for line in direct:
                line["error"] = errors(reference, line.pop("points"))
        first = runs.run(["slices", options.slice / 5, *bake, "--max-seconds", direct[0]["seconds"] + 1, "--quantity",
                          "direct"], seconds=1200)
        whole = runs.run(in_slices + ["--max-seconds", options.max_seconds], seconds=1200)
        slices = [line["seconds"] for line in whole[1:]]
        lit = next((line for line in direct if line["error"]["rms"] <= 0.3), None)
        at_vertices = next((line for line in first + direct if line["vertex_rms"] <= 0.3), None)
        result[scene.name] = row = {
            "slice": options.slice,
            "direct": direct,
            "first": first,
            "geometry": direct[0]["seconds"],
            "lit": lit and lit["total_seconds"],
            "lit_at_vertices": at_vertices and at_vertices["total_seconds"],
            "slices": len(slices),
            "late": sum(seconds > 1.5 * options.slice for seconds in slices),
            "longest": max(slices),
        }
        say(f"{scene.name:<12} geometry {row['geometry']:.2f} s; direct light within 30 % after "
            + (f"{row['lit']:.2f} s in all" if lit else "more than 10 s")
            + (f", at the vertices {row['lit_at_vertices']:.2f} s" if at_vertices else ", never at the vertices")
            + f"; of {row['slices']} slices of {options.slice} s in a whole bake {row['late']} took more than 1.5 times"
            + f" that, the longest {row['longest']:.3f} s")
    return result


def halving(scenes, options):
    """Mean error of four seeds, the tolerance halved from step to step."""
    result = {}
    for scene in scenes:
        rows = []
        for tolerance in (0.16, 0.08, 0.04, 0.02, 0.01, 0.005):
            bakes = [runs.bake(scene, ["--tolerance", tolerance, "--seed", seed], options.max_seconds)
                     for seed in (1, 2, 3, 4)]
            if not all(run and run["finished"] for run in bakes):
                break
            means = {figure: sum(run["error"][figure] for run in bakes) / 4 for figure in ("rms", "rms99", "local", "bias")}
            rows.append({"tolerance": tolerance, "error": means, "rays": sum(run["rays"] for run in bakes) / 4,
                         "cpu_seconds": sum(run["cpu_seconds"] for run in bakes) / 4})
            less = "" if len(rows) == 1 else f"  {100 * (means['rms'] / rows[-2]['error']['rms'] - 1):+.0f} %"
            say(f"{scene.name:<12} {tolerance:<6} rms {100 * means['rms']:.2f} %  rms99 {100 * means['rms99']:.2f} %  "
                f"{rows[-1]['rays'] / 1e6:.2f} M rays{less}")
        result[scene.name] = rows
    return result


def lattices(scenes, options):
    """Uniform hexagonal and quadrilateral meshes of as many sites; nothing else differs."""
    result = {}
    for scene in scenes:
        rows = []
        for sites in (1_000, 4_000, 16_000):
            for lattice, shape in (("hex", 1), ("quad", math.sqrt(math.sqrt(3) / 2))):
                spacing = curves.spacing_for(scene, sites) * shape
                run = runs.bake(scene, ["--lattice", lattice, "--patch-spacing", 2 * spacing, "--min-spacing", spacing,
                                        "--element-levels", 1, "--disable", "refinement", "--tolerance",
                                        options.tolerance, "--threads", 1], options.max_seconds)
                if run is None or not run["finished"]:
                    break
                rows.append({"lattice": lattice, "sites": run["sites"], "cpu_seconds": run["cpu_seconds"],
                             "error": run["error"]})
                curves.say(scene, lattice, run)
        result[scene.name] = rows
    return result


def tracer(scenes, options):
    """Is the path tracer right? Its mean error against the references, beside the standard error of that mean: the noise of
    the references and its own over the root of the number of points."""
    result = {}
    for scene in scenes:
        for direct in (False, True):
            reference = scene.reference(direct)
            if not reference:
                continue
            last = runs.trace_curve(scene, options.tracer_seconds, direct)[-1]
            irradiance, noise = load_reference(reference)
            allowed = math.sqrt(float((noise**2).sum()) / len(noise)) / irradiance.mean()
            allowed = math.hypot(allowed, last["error"]["rms"]) / math.sqrt(len(noise))
            name = scene.name + (" direct" if direct else "")
            result[name] = {**last, "bias_allowed": allowed}
            say(f"{name:<20} {last['samples']:>6} samples  bias {100 * last['error']['bias']:+.3f} % (standard "
                f"error {100 * allowed:.3f} %)  rms {100 * last['error']['rms']:.2f} %  "
                f"rms99 {100 * last['error']['rms99']:.2f} %")
    return result


def city(_, options):
    scene = runs.Scene(f"city:{options.triangles}", options.work)
    scene.reference = lambda direct=False: None
    run = runs.bake(scene, ["--tolerance", 0.2, "--threads", 2, *k_city_lights], options.max_seconds)
    if run is None:
        say(f"{scene.name}: no answer in {10 * options.max_seconds + 60:.0f} s")
        return {"finished": False, "stopped_after_seconds": 10 * options.max_seconds + 60}
    curves.say(scene, "tolerance 0.2", run)
    say(f"{'':<12} {run['input_triangles']:,} triangles, {run['seconds']:.0f} s on 2 threads, "
        f"{run['peak_bytes'] / 2**30:.2f} GiB by its count, {run['resident_bytes'] / 2**30:.2f} GiB resident")
    return run


k_studies = {"skips": skips, "threads": threads, "scaling": scaling, "embree": embree,
             "first-light": first_light, "city": city, "halving": halving, "lattices": lattices, "tracer": tracer}
