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
    picture, axes = pyplot.subplots(figsize=(5.6, 4.2), dpi=100)
    for method, (words, colour, marker) in k_styles.items():
        runs = [r for r in curves.get(method, []) if r.get("error") and r["error"][figure] > 0]
        if not runs:
            continue
        for finished, style in ((True, {}), (False, {"markerfacecolor": "none", "linestyle": "none"})):
            told = [r for r in runs if r.get("finished", True) == finished]  # hollow: stopped by the limit of time
            label = words.format(points=f"{points:,}") if finished or len(told) == len(runs) else None
            if told:
                axes.plot([r["cpu_seconds"] for r in told], [100 * r["error"][figure] for r in told], color=colour,
                          marker=marker, markersize=4 if finished else 7, label=label, **style)
    axes.set_xscale("log")
    axes.set_yscale("log")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.set_xlabel("processor seconds, all in")
    axes.set_ylabel(f"{figure} error, %")
    axes.set_title(scene, fontsize=10)
    axes.grid(True, which="major", color="#cccccc", linewidth=0.6)
    axes.grid(True, which="minor", color="#eeeeee", linewidth=0.4)
    axes.legend(fontsize=7, loc="upper center", bbox_to_anchor=(0.5, -0.2), ncol=2, frameon=False)
    picture.tight_layout()
    picture.savefig(file, pil_kwargs={"optimize": True})
    pyplot.close(picture)
