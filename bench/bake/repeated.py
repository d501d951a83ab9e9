"""What one bake leaves to chance hides what a skip does: two bakes that differ in the seed alone differ by more than a
skip may move. Means over many seeds do not, and products of different seeds' differences have no noise in their mean: so
squares are estimated without bias, with the jackknife's standard error."""
import math

import numpy


def lasting_square(differences):
    """Of S seeds' differences (S x points x channels), the mean square over the points of what all seeds share, and its
    standard error. Unbiased, so it may be below 0."""
    seeds = len(differences)
    flat = differences.reshape(seeds, -1)
    products = flat @ flat.T / flat.shape[1]
    apart = products.sum() - numpy.trace(products)
    square = apart / (seeds * (seeds - 1))
    # Without one seed each: the sum loses that seed's row and column.
    without = (apart - 2 * (products.sum(axis=1) - numpy.diag(products))) / ((seeds - 1) * (seeds - 2))
    return float(square), math.sqrt((seeds - 1) / seeds * float(((without - without.mean()) ** 2).sum()))


def root_of(square, error):
    """The root, its standard error, and what it is at most: two standard errors of the square up."""
    root = math.sqrt(max(0.0, square))
    most = math.sqrt(max(0.0, square) + 2 * error)
    return {"rms": root, "standard_error": min(error / (2 * root), most / 2) if root > 0 else most / 2, "at_most": most}


def mean_of(numbers):
    seeds = len(numbers)
    return float(numpy.mean(numbers)), float(numpy.std(numbers, ddof=1)) / math.sqrt(seeds)


def moved(off, on, mean):
    """How far a skip moves the light, from bakes without and with it, one seed a row: all over the mean irradiance."""
    differences = (on - off) / mean
    brighter, error = mean_of(differences.mean(axis=(1, 2)))
    return {**root_of(*lasting_square(differences)), "brighter": brighter, "brighter_standard_error": error}


def chance(values, mean):
    """How far two bakes are from each other that differ in the seed alone."""
    return math.sqrt(2 * float((values.var(axis=0, ddof=1)).mean())) / mean


def lasting_error(values, reference, noise, mean):
    """The error that is left in the mean of all seeds, and their bias. noise: standard errors of the reference."""
    errors = (values - reference) / mean
    square, error = lasting_square(errors)
    bias, bias_error = mean_of(errors.mean(axis=(1, 2)))
    square -= float((noise**2).mean()) / mean**2
    return {**root_of(square, error), "bias": bias, "bias_standard_error": bias_error}


def check():
    """Light that is known to move by 0.002 under noise of 0.006 in each bake; and light that does not move."""
    random = numpy.random.default_rng(1)
    shape = (24, 1000, 3)
    for shift in (0.002, 0.0):
        found = []
        for _ in range(40):
            noise = [0.006 * random.standard_normal(shape) for _ in range(2)]
            moves = shift * numpy.sign(random.standard_normal(shape[1:]))
            found.append(lasting_square(1 + noise[0] + moves - (1 + noise[1])))
        squares, errors = (numpy.array(column) for column in zip(*found))
        spread = float(squares.std(ddof=1))
        if abs(squares.mean() - shift**2) > 4 * spread / math.sqrt(len(found)):
            raise AssertionError(f"a shift of {shift} is found as the root of {squares.mean()}")
        if not 0.6 < errors.mean() / spread < 1.7:
            raise AssertionError(f"squares scatter by {spread}, and are said to by {errors.mean()}")
