"""Check assets/metals/ and assets/cie/ against tests/data/ground_truth.csv.

    python scripts/check_reference.py            worst CIEDE2000; exit 1 above 0.05
    python scripts/check_reference.py --errors   also the error of two models, per data set

The reflected colour of a metal by the spectral route, written independently of the Rust code:
380–780 nm at 1 nm, plain sum; n and k linear between rows, ends held; exact unpolarised Fresnel
in air; D65 for sRGB and CIE D60 for ACEScg, scaled by Bradford from the computed white to the
nominal one, so that a perfect reflector is (1, 1, 1). Lab is relative to the space's white.
"""

import argparse
import csv
import sys
import warnings
from collections import defaultdict
from pathlib import Path

import numpy as np

with warnings.catch_warnings():
    warnings.simplefilter("ignore")  # on optional packages that are not needed here
    from colour.difference import delta_E_CIE2000

ROOT = Path(__file__).resolve().parent.parent
WAVELENGTH_NM = np.arange(380, 781)
TOLERANCE = 0.05

BRADFORD = np.array(
    [[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]]
)
# xy of red, green, blue and white, and the column of illuminants.csv.
SPACES = {
    "sRGB": ([(0.64, 0.33), (0.30, 0.60), (0.15, 0.06)], (0.3127, 0.3290), "d65"),
    "ACEScg": ([(0.713, 0.293), (0.165, 0.830), (0.128, 0.044)], (0.32168, 0.33767), "d60"),
}


def columns(path: Path) -> dict[str, np.ndarray]:
    """A CSV file of numbers by column name, its `#` header skipped."""
    lines = [line for line in path.read_text("utf-8").splitlines() if not line.startswith("#")]
    values = np.array([[float(field) for field in line.split(",")] for line in lines[1:]])
    return dict(zip(lines[0].split(","), values.T, strict=True))


def xyz_of(xy: tuple[float, float]) -> np.ndarray:
    x, y = xy
    return np.array([x / y, 1.0, (1 - x - y) / y])


class Space:
    """From spectral reflectance to the linear RGB of a space, and from there to Lab."""

    def __init__(self, name: str) -> None:
        primaries, white, illuminant = SPACES[name]
        unscaled = np.transpose([xyz_of(xy) for xy in primaries])
        self.white = xyz_of(white)
        self.xyz_from_rgb = unscaled * np.linalg.solve(unscaled, self.white)

        observer = columns(ROOT / "assets/cie/observer_1931_2deg.csv")
        power = columns(ROOT / "assets/cie/illuminants.csv")[illuminant]
        weights = power * np.array([observer["x_bar"], observer["y_bar"], observer["z_bar"]])
        weights /= weights[1].sum()
        gain = (BRADFORD @ self.white) / (BRADFORD @ weights.sum(1))
        adapted = np.linalg.solve(BRADFORD, gain[:, None] * (BRADFORD @ weights))
        self.rgb_from_spectrum = np.linalg.solve(self.xyz_from_rgb, adapted)

    def rgb(self, reflectance: np.ndarray) -> np.ndarray:
        return reflectance @ self.rgb_from_spectrum.T

    def lab(self, rgb: np.ndarray) -> np.ndarray:
        t = rgb @ self.xyz_from_rgb.T / self.white
        delta = 6 / 29
        f = np.where(t > delta**3, np.cbrt(t), t / (3 * delta**2) + 4 / 29)
        x, y, z = np.moveaxis(f, -1, 0)
        return np.stack([116 * y - 16, 500 * (x - y), 200 * (y - z)], -1)

    def delta_e(self, rgb_a: np.ndarray, rgb_b: np.ndarray) -> np.ndarray:
        return delta_E_CIE2000(self.lab(rgb_a), self.lab(rgb_b))


def fresnel(n: np.ndarray, k: np.ndarray, cosine: np.ndarray) -> np.ndarray:
    """Unpolarised reflectance of n + ik in air, by complex amplitudes: cosine × wavelength."""
    index = n + 1j * k
    cosine = cosine[:, None]
    # cos of the refracted ray, times the index
    inside = np.sqrt(index**2 - (1 - cosine**2))
    s = (cosine - inside) / (cosine + inside)
    p = (index**2 * cosine - inside) / (index**2 * cosine + inside)
    return (abs(s) ** 2 + abs(p) ** 2) / 2


def reflectance(dataset: str, cosine: np.ndarray) -> np.ndarray:
    metal = columns(ROOT / f"assets/metals/{dataset}.csv")
    n, k = (np.interp(WAVELENGTH_NM, metal["wavelength_nm"], metal[symbol]) for symbol in "nk")
    return fresnel(n, k, cosine)


def worst_difference(spaces: dict[str, Space]) -> float:
    """The largest CIEDE2000 against the reference values; prints one line per data set."""
    lines = (ROOT / "tests/data/ground_truth.csv").read_text("utf-8").splitlines()
    reference = defaultdict(list)
    for row in csv.DictReader(line for line in lines if not line.startswith("#")):
        angle_and_rgb = [float(row[field]) for field in ("theta_deg", "red", "green", "blue")]
        reference[row["dataset"], row["space"]].append(angle_and_rgb)
    worst = 0.0
    for (dataset, name), values in reference.items():
        theta_deg, rgb = np.split(np.array(values), [1], axis=1)
        cosine = np.cos(np.radians(theta_deg[:, 0]))
        here = spaces[name].rgb(reflectance(dataset, cosine))
        difference = spaces[name].delta_e(here, rgb).max()
        print(f"{dataset:24} {name:8} {difference:.5f}  RGB ±{abs(here - rgb).max():.1e}")
        worst = max(worst, difference)
    return worst


def print_model_errors(spaces: dict[str, Space]) -> None:
    """Mean and maximum CIEDE2000 over θ = 0, 1, …, 90° of Schlick (r) and Hoffman (r, h)."""
    cosine = np.cos(np.radians(np.arange(91)))
    x = 1 - cosine[:, None]
    print(f"{'':24} {'':8} {'Schlick':>14} {'Hoffman':>14}")
    for path in sorted((ROOT / "assets/metals").glob("*.csv")):
        truth = reflectance(path.stem, cosine)
        ends = reflectance(path.stem, np.array([1, 1 / 7]))
        for name, space in spaces.items():
            r, h = space.rgb(ends)
            schlick = r + (1 - r) * x**5
            a = 823543 / 46656 * (r - h) + 49 / 6 * (1 - r)
            hoffman = schlick - a * (1 - x) * x**6
            errors = [space.delta_e(space.rgb(truth), model) for model in (schlick, hoffman)]
            texts = [f"{error.mean():7.3f} {error.max():6.2f}" for error in errors]
            print(f"{path.stem:24} {name:8} {' '.join(texts)}")


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--errors", action="store_true", help="errors of Schlick and Hoffman")
    arguments = parser.parse_args()

    spaces = {name: Space(name) for name in SPACES}
    worst = worst_difference(spaces)
    print(f"worst CIEDE2000 against the reference: {worst:.5f} (tolerance {TOLERANCE})")
    if arguments.errors:
        print_model_errors(spaces)
    return 0 if worst <= TOLERANCE else 1


if __name__ == "__main__":
    sys.exit(main())
