"""Each skip's worth, and whether it is harmless: many seeds with all skips on, the same with one of them off."""
import numpy

import repeated
import runs
from errors import load_reference


def skips(scenes, options):
    """Seconds, rays and error with each skip off; how far the skip moves the light at the reference's points, beside a
    tenth of the tolerance; and the error that no seed takes away, with and without it."""
    repeated.check()
    return {scene.name: skips_of(scene, options) for scene in scenes}


def skips_of(scene, options):
    reference, noise = load_reference(scene.reference())
    mean = reference.mean()
    rows = bake_all(scene, options)
    on = rows["none"].pop("values")
    values = {"none": on, **{skip: row.pop("values") for skip, row in rows.items() if skip != "none"}}
    rows["none"]["chance"] = repeated.chance(on, mean)
    say(f"{scene.name:<12} {len(on)} seeds; two of them differ by {100 * rows['none']['chance']:.2f} %; a tenth of the "
        f"tolerance is {10 * options.tolerance:.3g} %")
    for skip, row in rows.items():
        row["lasting_error"] = repeated.lasting_error(values[skip], reference, noise, mean)
        words = (f"{scene.name:<12} {'all on' if skip == 'none' else skip + ' off':<17} {row['cpu_seconds']:.3f} s  "
                 f"{row['rays'] / 1e6:.2f} M rays  rms {100 * row['rms']:.2f} %, of the mean "
                 f"{100 * row['lasting_error']['rms']:.2f} %  bias {100 * row['lasting_error']['bias']:+.3f} %")
        if skip != "none":
            row["moved"] = repeated.moved(values[skip], on, mean)
            row["harmless"] = row["moved"]["at_most"] < 0.1 * options.tolerance
            words += f"  moved {describe(row['moved'])}"
        say(words)
    return rows


def bake_all(scene, options):
    """Seed by seed, in turns, so that a busy machine is so to all."""
    found = {skip: [] for skip in ("none", *options.off)}
    for seed in range(1, options.seeds + 1):
        for skip, bakes in found.items():
            arguments = ["--tolerance", options.tolerance, "--threads", 1, "--seed", seed]
            arguments += ["--disable", skip] if skip != "none" else []
            run = runs.bake(scene, arguments, options.max_seconds, keep=True)
            if run is None or not run["finished"]:
                raise RuntimeError(f"{scene.name} with {skip} off is not done in {options.max_seconds} s")
            bakes.append(run)
    return {skip: summary(bakes) for skip, bakes in found.items()}


def summary(bakes):
    """Seconds of the least disturbed bake; means of the rest."""
    counts = ("rays", "sites", "skipped_facing", "skipped_negligible", "skipped_lazy", "skipped_clear")
    row = {name: sum(run[name] for run in bakes) / len(bakes) for name in counts}
    row["seeds"] = len(bakes)
    row["cpu_seconds"] = min(run["cpu_seconds"] for run in bakes)
    row["rms"] = sum(run["error"]["rms"] for run in bakes) / len(bakes)
    row["values"] = numpy.array([run["values"] for run in bakes])
    return row


def describe(moved):
    return (f"{100 * moved['rms']:.3f} ± {100 * moved['standard_error']:.3f} %, brighter "
            f"{100 * moved['brighter']:+.4f} ± {100 * moved['brighter_standard_error']:.4f} %")


def say(words):
    print(words, flush=True)
