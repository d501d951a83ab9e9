#!/usr/bin/env python3
"""The tables of docs/performance.md from what bake_bench.py measured: tables.py build/bench/bake.json"""
import json
import sys


def percent(value, digits=1):
    return f"{100 * value:.{digits}f} %"


def with_error(value, error, sign=""):
    return f"{100 * value:{sign}.3f} ± {100 * error:.3f} %"


def table(heading, rows):
    print("| " + " | ".join(heading) + " |")
    print("|" + "---|" * len(heading))
    for row in rows:
        print("| " + " | ".join(str(cell) for cell in row) + " |")
    print()


def seconds(value):
    return "–" if value is None else f"{value:.3g} s"


def times(value):
    return "–" if value is None else f"{value:.2g}"


def curves(data):
    rows = []
    for scene, summary in data.get("summary", {}).items():
        for row in summary:
            rows.append([scene, f"{row['figure']} {percent(row['error'], 0)}",
                         *(seconds(row.get(method)) for method in ("radvor", "uniform", "tracer", "cycles")),
                         times(row.get("times_tracer")), times(row.get("times_tracer_at_equal_receivers")),
                         *(f"{row[m] / 1e6:.2f} M" if row.get(m) else "–" for m in ("radvor_rays", "uniform_rays"))])
    table(["scene", "error", "radvor", "uniform, all evaluated", "tracer", "Cycles", "tracer over radvor",
           "at as many receivers", "radvor's rays", "uniform's rays"], rows)
    rows = []
    for scene, methods in data.get("curves", {}).items():
        for method in ("radvor", "uniform", "cycles"):
            for run in methods.get(method, []):
                error = run.get("error")
                if not error:
                    continue
                what = {"radvor": f"radvor {run.get('tolerance')}", "uniform": "uniform",
                        "cycles": f"Cycles, {run.get('samples')} samples"}[method]
                what += "" if run.get("finished", True) else " (time spent)"
                rows.append([scene, what, percent(error["rms"]), percent(error["rms99"]), percent(error["local"]),
                             f"{100 * error['bias']:+.2f} %", percent(error["p95"]),
                             f"{run['sites']:,}" if "sites" in run else f"{run['vertices']:,}",
                             f"{run['rays'] / 1e6:.2f} M" if "rays" in run else "–", seconds(run["cpu_seconds"])])
    table(["scene", "what", "rms", "rms99", "local", "bias", "p95", "sites", "rays", "processor time"], rows)


def skips(data):
    rows = []
    for scene, study in data.get("skips", {}).items():
        base = study["none"]
        for skip, row in study.items():
            left = row["lasting_error"]
            moved = row.get("moved")
            rows.append([scene, "all on" if skip == "none" else f"{skip} off", row["seeds"], seconds(row["cpu_seconds"]),
                         f"{row['cpu_seconds'] / base['cpu_seconds']:.2f}", f"{row['rays'] / 1e6:.2f} M",
                         percent(row["rms"], 2), with_error(left["rms"], left["standard_error"]),
                         with_error(left["bias"], left["bias_standard_error"], "+"),
                         with_error(moved["rms"], moved["standard_error"]) if moved else "–",
                         with_error(moved["brighter"], moved["brighter_standard_error"], "+") if moved else "–"])
    table(["scene", "skips", "seeds", "processor time", "over all on", "rays", "rms", "rms of the seeds' mean", "bias",
           "light moved by", "brighter with it on"], rows)


def threads(data):
    table(["scene", "1 thread", "2 threads", "faster", "two bakes side by side", "processor time of 2 over 1", "load"],
          [[scene, *(seconds(v) for v in row["seconds"].values()), f"{row['speed']:.2f}", f"{row['bound']:.2f}",
            f"{row['cpu_seconds_of_two_over_one']:.2f}", f"{row['load']:.1f}"]
           for scene, row in data.get("threads", {}).items()])


def scaling(data):
    rows = []
    for what, series in data.get("scaling", {}).items():
        for row in series:
            rows.append([what, f"{row['count']:,}", seconds(row["cpu_seconds"]), f"{row['sites']:,}",
                         f"{row['exponent']:.2f}" if "exponent" in row else "–"])
    table(["what grows", "to", "processor time", "sites", "exponent"], rows)


def memory(data):
    """Of the bakes at the default tolerance; peaks are the library's own count, Embree's included."""
    rows = []
    for scene, methods in data.get("curves", {}).items():
        for run in methods.get("radvor", []):
            if run["tolerance"] == 0.02:
                peak = run["peak_bytes"]
                rows.append([scene, f"{peak / 1e6:.0f} MB", f"{run['sites']:,}", f"{peak / max(1, run['sites']):,.0f}",
                             f"{peak / run['input_triangles']:,.0f}"])
    table(["scene", "peak", "sites", "bytes a site", "bytes an input triangle"], rows)


def embree(data):
    table(["scene", "all in", "rays", "bare loop", "all in over bare", "bare rays a second", "building Embree's tree"],
          [[scene, seconds(row["cpu_seconds"]), f"{row['rays'] / 1e6:.2f} M", seconds(row["bare_loop_cpu_seconds"]),
            f"{1 / row['share_of_rays']:.2f}" if row["share_of_rays"] > 0 else "–",
            f"{row.get('bare_rays_per_second', 0) / 1e6:.1f} M", percent(row["share_of_build"])]
           for scene, row in data.get("embree", {}).items()])


def first_light(data):
    table(["scene", "geometry", "direct light within 30 %", "at the vertices", "slices of a whole bake",
           "over 1.5 times what they were given", "the longest"],
          [[scene, *(seconds(row[what]) for what in ("geometry", "lit", "lit_at_vertices")), row["slices"], row["late"],
            f"{row['longest']:.3f} s"] for scene, row in data.get("first-light", {}).items()])


def lattices(data):
    rows = []
    for scene, series in data.get("lattices", {}).items():
        for row in series:
            rows.append([scene, {"hex": "hexagons", "quad": "squares"}[row["lattice"]], f"{row['sites']:,}",
                         percent(row["error"]["rms"], 2), percent(row["error"]["rms99"], 2),
                         percent(row["error"]["local"]), seconds(row["cpu_seconds"])])
    table(["scene", "cells", "sites", "rms", "rms99", "local", "processor time"], rows)


def halving(data):
    table(["scene", "tolerance", "rms", "rms99", "local", "bias", "rays", "processor time"],
          [[scene, row["tolerance"], *(percent(row["error"][figure], 2) for figure in ("rms", "rms99", "local", "bias")),
            f"{row['rays'] / 1e6:.2f} M", seconds(row["cpu_seconds"])]
           for scene, rows in data.get("halving", {}).items() for row in rows])


def tracer(data):
    table(["scene", "samples", "bias", "its standard error", "rms beyond the reference's noise", "rms99"],
          [[scene, f"{row['samples']:,}", f"{100 * row['error']['bias']:+.3f} %", percent(row["bias_allowed"], 3),
            percent(row["error"]["rms"], 2), percent(row["error"]["rms99"], 2)]
           for scene, row in data.get("tracer", {}).items()])


def main():
    data = json.loads(open(sys.argv[1]).read())
    print(json.dumps(data.get("machine")))
    for part in (curves, tracer, skips, threads, scaling, memory, embree, first_light, lattices, halving):
        print(f"\n### {part.__name__}\n")
        part(data)
    print(json.dumps({key: value for key, value in data.get("city", {}).items() if key != "options"}, indent=1))


if __name__ == "__main__":
    main()
