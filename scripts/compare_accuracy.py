"""Compute the table of errors in Python, and time it: metals × models × 0–90°, CIEDE2000 against the spectrum.

    edgewise study speed --error-table > table.json
    python scripts/compare_accuracy.py table.json

The same parameters, angles and wavelengths, with numpy and colour-science, twice: one call for each curve, as programs
are written, and all curves in one array. Prints one JSON object, which `edgewise study speed --evidence --python` reads;
exit 1 where a mean differs from the program's by more than 0.001.
"""

import argparse
import json
import platform
import sys
import time
import warnings
from importlib.metadata import version
from pathlib import Path

import numpy as np

with warnings.catch_warnings():
    warnings.simplefilter("ignore")  # on optional packages that are not needed here
    from colour.difference import delta_E_CIE2000
    from colour.models import XYZ_to_Lab, XYZ_to_xy

TOLERANCE = 1e-3
COSINE = np.cos(np.radians(np.arange(91)))[:, None]
Q = (6 / 7) ** 5


def conductor(n, k, c):
    """Exact unpolarised Fresnel reflectance in air."""
    s2 = 1 - c * c
    t0 = n * n - k * k - s2
    modulus = np.sqrt(t0 * t0 + 4 * n * n * k * k)
    a = np.sqrt(np.maximum(0, (modulus + t0) / 2))
    t1, t2 = modulus + c * c, 2 * c * a
    s = (t1 - t2) / (t1 + t2)
    t3, t4 = c * c * modulus + s2 * s2, t2 * s2
    return 0.5 * s * (1 + (t3 - t4) / (t3 + t4))


def schlick(r, c):
    return r + (1 - r) * (1 - c) ** 5


def hoffman(r, h, c):
    a = (r + (1 - r) * Q - h) / ((1 / 7) * (6 / 7) ** 6)
    return schlick(r, c) - a * c * (1 - c) ** 6


def generalized_schlick(r0, t, r90, p, c):
    at_max = r0 + (r90 - r0) * (6 / 7) ** p
    a = at_max * (1 - t) / ((1 / 7) * (6 / 7) ** 6)
    return r0 + (r90 - r0) * (1 - c) ** p - a * c * (1 - c) ** 6


def gulbrandsen(r, g, c):
    """n and k of r and g without the cancellation of the printed k."""
    s = np.sqrt(r)
    with np.errstate(divide="ignore", invalid="ignore"):
        d = 2 * s * (1 + s) ** 2 / ((1 - r) * (1 + r))
        n = (1 - r) / (1 + r) + (1 - g) * d
        k2 = g * d * ((1 - g) * 4 * s / (1 - r) + g * 2 * s * (1 - r) / ((1 + r) * (1 + s) ** 2))
        return np.where(r >= 1, 1.0, conductor(n, np.sqrt(k2), c))


def series(r, first_power, bend, coefficients, c):
    x, t = 1 - c, (1 - (2 + bend) * c) / (1 + bend * c)
    total = np.zeros_like(x * r)
    for b in reversed(coefficients):
        total = total * t + b
    return schlick(r, c) + total * c * x**first_power


MODELS = {
    "schlick": (schlick, ["r"]),
    "hoffman": (hoffman, ["r", "h"]),
    "f82-tint": (lambda r, t, c: hoffman(r, t * (r + (1 - r) * Q), c), ["r", "t"]),
    "lazanyi": (lambda r, a, alpha, c: schlick(r, c) - a * c * (1 - c) ** alpha, ["r", "a", "alpha"]),
    "generalized-schlick": (generalized_schlick, ["r0", "t", "r90", "p"]),
    "gulbrandsen": (gulbrandsen, ["r", "g"]),
    "conductor": (conductor, ["n", "k"]),
}


def curve(form):
    """One curve: 91 angles × 3 channels."""
    if form["form"] == "series":
        coefficients = [np.array(b) for b in form["coefficients"]]
        return series(np.array(form["r"]), form["first_power"], form["bend"], coefficients, COSINE)
    model = form["model"]
    function, names = MODELS[model["kind"]]
    return function(*(np.array(model[name]) for name in names), COSINE)


def truth(form):
    """The spectral sum: 91 angles × 3 channels."""
    return conductor(np.array(form["n"]), np.array(form["k"]), COSINE) @ np.array(form["weights"])


class Table:
    def __init__(self, document):
        self.metals = document["metals"]
        self.xyz_from_rgb = np.array(document["xyz_from_rgb"])
        self.white = XYZ_to_xy(np.array(document["white_xyz"]))
        self.models = len(self.metals[0]["models"])

    def lab(self, rgb):
        return XYZ_to_Lab(rgb @ self.xyz_from_rgb.T, self.white)

    def curve_by_curve(self):
        """The mean ΔE of each model of each metal, one call for each curve."""
        means = []
        for metal in self.metals:
            true = self.lab(truth(metal["truth"]))
            for model in metal["models"]:
                means.append(np.mean(delta_E_CIE2000(true, self.lab(curve(model["form"])))))
        return np.array(means)

    def prepared(self):
        """Every model's parameters over all metals in one array, as a program that is written for speed keeps them."""
        stack = lambda values: np.array(values, dtype=float).reshape(len(self.metals), 1, -1)
        columns = []
        for index in range(self.models):
            forms = [metal["models"][index]["form"] for metal in self.metals]
            if forms[0]["form"] == "series":
                count = len(forms[0]["coefficients"])
                coefficients = [stack([form["coefficients"][i] for form in forms]) for i in range(count)]
                shape, r = (forms[0]["first_power"], forms[0]["bend"]), stack([form["r"] for form in forms])
                columns.append((lambda r, b, c, shape=shape: series(r, *shape, b, c), [r, coefficients]))
            else:
                function, names = MODELS[forms[0]["model"]["kind"]]
                columns.append((function, [stack([form["model"][name] for form in forms]) for name in names]))
        spectral = [metal["truth"] for metal in self.metals]
        return columns, (stack([t["n"] for t in spectral]), stack([t["k"] for t in spectral]), np.array(spectral[0]["weights"]))

    def batched(self, prepared):
        """The same with all curves in one array."""
        columns, (n, k, weights) = prepared
        true = self.lab(conductor(n, k, COSINE[None]) @ weights)
        curves = np.stack([function(*parameters, COSINE[None]) for function, parameters in columns], axis=1)
        return np.mean(delta_E_CIE2000(true[:, None], self.lab(curves)), axis=-1).ravel()


def shortest_ms(work, times):
    def once():
        start = time.perf_counter()
        work()
        return time.perf_counter() - start

    return 1e3 * min(once() for _ in range(times))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("table", type=Path, help="what `edgewise study speed --error-table` printed")
    table = Table(json.loads(parser.parse_args().table.read_text()))
    prepared = table.prepared()
    ours = np.array([model["mean_delta_e"] for metal in table.metals for model in metal["models"]])
    largest = max(np.abs(means - ours).max() for means in (table.curve_by_curve(), table.batched(prepared)))
    print(
        json.dumps(
            {
                "python": platform.python_version(),
                "numpy": version("numpy"),
                "colour": version("colour-science"),
                "curve_by_curve_ms": shortest_ms(table.curve_by_curve, 5),
                "batched_ms": shortest_ms(lambda: table.batched(prepared), 20),
                "largest_difference": float(largest),
            },
            indent=2,
        )
    )
    sys.exit(not largest <= TOLERANCE)


if __name__ == "__main__":
    main()
