"""Error against processor seconds, both logarithmic: one small picture for each scene."""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as pyplot
from matplotlib.ticker import FuncFormatter

k_styles = {  # method: its words, colour, marker
    "radvor": ("radvor, tolerance 0.3 to 0.002", "#0072b2", "o"),
    "uniform": ("radvor, uniform, nothing skipped", "#56b4e9", "s"),
    "tracer": ("path tracer at {points} points", "#d55e00", "^"),
    "cycles": ("Cycles, vertex bake of the uniform mesh", "#009e73", "D"),
}


def draw(scene, figure, curves, points, file):
    """curves: method -> list of runs; figure: rms or rms99."""
    picture, axes = pyplot.subplots(figsize=(5.6, 3.8), dpi=100)
    for method, (words, colour, marker) in k_styles.items():
        runs = [r for r in curves.get(method, []) if r.get("error") and r["error"][figure] > 0]
        if not runs:
            continue
        x = [r["cpu_seconds"] for r in runs]
        y = [100 * r["error"][figure] for r in runs]
        axes.plot(x, y, color=colour, marker=marker, markersize=4, label=words.format(points=f"{points:,}"))
        cut = [(a, b) for a, b, r in zip(x, y, runs) if not r.get("finished", True)]
        if cut:  # hollow: stopped by the limit of time
            axes.plot(*zip(*cut), marker=marker, markersize=9, color=colour, markerfacecolor="none", linestyle="none")
    axes.set_xscale("log")
    axes.set_yscale("log")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.set_xlabel("processor seconds, all in")
    axes.set_ylabel(f"{figure} error, %")
    axes.set_title(scene, fontsize=10)
    axes.grid(True, which="major", color="#cccccc", linewidth=0.6)
    axes.grid(True, which="minor", color="#eeeeee", linewidth=0.4)
    axes.legend(fontsize=7)
    picture.tight_layout()
    picture.savefig(file, pil_kwargs={"optimize": True})
    pyplot.close(picture)
