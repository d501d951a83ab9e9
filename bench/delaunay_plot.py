"""Plots what delaunay_bench measured: our time over CGAL's, one bar a workload, beside the ratio that is aimed at.

usage: delaunay_plot.py RESULTS.json [PICTURE.png]    without a picture's name: beside the results
"""

import json
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from PIL import Image


def plot(results, picture):
    rows = results["rows"][::-1]
    figure, axes = plt.subplots(figsize=(8, 0.42 * len(rows) + 1.3), dpi=100)
    for y, row in enumerate(rows):
        reached = row["ratio"] <= row["target"]
        axes.barh(y, row["ratio"], color="#4c78a8" if reached else "#d1605e", height=0.62)
        axes.plot([row["target"]] * 2, [y - 0.42, y + 0.42], color="black", linewidth=1.6)
        axes.text(max(row["ratio"], row["target"]) + 0.02, y, f"{row['ours_ns']:.0f} : {row['cgal_ns']:.0f} ns",
                  va="center", fontsize=8)
    axes.axvline(1, color="gray", linewidth=0.8, linestyle=":")
    axes.set_yticks(range(len(rows)), [row["name"] for row in rows], fontsize=9)
    axes.set_xlim(0, max(1.25, max(row["ratio"] for row in rows) + 0.25))
    axes.set_xlabel("time, radvor / CGAL (black marks: at most); median of "
                    f"{results['rounds']} rounds; {results['bytes_a_point']:.0f} bytes a point", fontsize=9)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    figure.tight_layout()
    figure.savefig(picture)
    Image.open(picture).convert("RGB").quantize(32).save(picture, optimize=True)
    print(picture)


if __name__ == "__main__":
    source = pathlib.Path(sys.argv[1])
    plot(json.loads(source.read_text()), sys.argv[2] if len(sys.argv) > 2 else source.with_suffix(".png"))
