"""Errors of irradiance at points, relative to the reference's mean: the definitions of ../shared/scenes/compare.py, which
bake_bench.py checks against that file where it exists."""
import csv
import math

import numpy

k_figures = ("rms", "rms99", "local", "bias", "p95", "max", "lost")


def load_reference(file):
    """Irradiance (n x 3) and standard errors (n)."""
    with open(file) as lines:
        rows = list(csv.DictReader(lines))
    return (
        numpy.array([[float(row[c]) for c in "rgb"] for row in rows]),
        numpy.array([float(row["se"]) for row in rows]),
    )


def load_values(file):
    """Irradiance (n x 3) and whether there was a surface (n)."""
    with open(file) as lines:
        rows = list(csv.DictReader(lines))
    return (
        numpy.array([[float(row[c]) for c in "rgb"] for row in rows]),
        numpy.array([int(row["found"]) for row in rows]),
    )


def errors(reference_file, values_file):
    reference, standard_error = load_reference(reference_file)
    values, found = load_values(values_file)
    if len(reference) != len(values):
        raise ValueError(f"{reference_file} has {len(reference)} points, {values_file} has {len(values)}")
    if not numpy.isfinite(values).all():
        raise ValueError(f"{values_file}: a value that is not finite")
    count = len(reference)
    mean = reference.mean()
    error = values - reference
    squares = (error**2).mean(axis=1)
    noise = float((standard_error**2).sum())
    kept = numpy.sort(squares)[: count - count // 100]
    absolute = numpy.sqrt(numpy.sort(squares))
    return {
        "points": count,
        "rms": math.sqrt(max(0.0, float(squares.sum()) - noise) / count) / mean,
        "rms99": math.sqrt(max(0.0, float(kept.sum()) - noise) / len(kept)) / mean,
        "local": math.sqrt(float(((error / (reference + 0.1 * mean)) ** 2).mean())),
        "bias": float(error.mean()) / mean,
        "p95": float(absolute[min(count - 1, int(0.95 * count))]) / mean,
        "max": float(absolute[-1]) / mean,
        "lost": float((found == 0).mean()),
        "reference_noise": math.sqrt(noise / count) / mean,
    }


def cost_at(curve, figure, error, cost="cpu_seconds"):
    """Interpolates a curve's cost, straight in logarithms, where it first falls to an error; None where it
    never does. Where its first point is below already, that point's cost: an upper bound."""
    points = [(p[cost], p["error"][figure]) for p in curve if p.get("finished", True)]
    for i, (spent, value) in enumerate(points):
        if value <= error:
            if i == 0 or value <= 0:
                return spent
            before_spent, before = points[i - 1]
            share = (math.log(before) - math.log(error)) / (math.log(before) - math.log(value))
            return math.exp(math.log(before_spent) * (1 - share) + math.log(spent) * share)
    return None
