"""Write assets/cie/: the CIE 1931 observer and the illuminants D65 and D60, 380–780 nm at 1 nm.

    python scripts/make_cie.py            write the files
    python scripts/make_cie.py --check    compare instead; exit 1 if anything differs

The tables are those of `colour-science`. The observer is tabulated at 1 nm there; the
illuminants at 5 nm, between which the CIE prescribes linear interpolation (CIE 15:2018).
"""

import argparse
import sys
import warnings
from importlib.metadata import version
from pathlib import Path

import numpy as np

with warnings.catch_warnings():
    warnings.simplefilter("ignore")  # on optional packages that are not needed here
    import colour

from generated import compare, write

OUTPUT = Path(__file__).resolve().parent.parent / "assets" / "cie"
WAVELENGTH_NM = np.arange(380, 781)
PACKAGE = f"colour-science {version('colour-science')}"
PROVENANCE = {
    "url": "https://www.colour-science.org",
    "licence": "BSD-3-Clause (colour-science)",
}


def csv(header: dict[str, str], columns: dict[str, np.ndarray]) -> bytes:
    """Provenance, column names and rows, the numbers as short as they are exact."""
    lines = [f"# {key}: {value}" for key, value in header.items()]
    lines.append(",".join(["wavelength_nm", *columns]))
    for wavelength_nm, *values in zip(WAVELENGTH_NM, *columns.values(), strict=True):
        texts = [np.format_float_positional(value, trim="-") for value in values]
        lines.append(",".join([str(wavelength_nm), *texts]))
    return ("\n".join(lines) + "\n").encode()


def observer() -> bytes:
    name = "CIE 1931 2 Degree Standard Observer"
    table = colour.MSDS_CMFS[name]
    rows = np.searchsorted(table.wavelengths, WAVELENGTH_NM)
    x_bar, y_bar, z_bar = table.values[rows].T
    header = {
        "name": "CIE 1931 standard colorimetric observer, 2°",
        "publication": "ISO/CIE 11664-1:2019, table at 1 nm",
        "source": f'{PACKAGE}, colour.MSDS_CMFS["{name}"]',
        **PROVENANCE,
    }
    return csv(header, {"x_bar": x_bar, "y_bar": y_bar, "z_bar": z_bar})


def illuminant(name: str) -> np.ndarray:
    """Relative spectral power, 100 at 560 nm, interpolated linearly from the table at 5 nm."""
    table = colour.SDS_ILLUMINANTS[name]
    power = np.interp(WAVELENGTH_NM, table.wavelengths, table.values)
    return power.round(6)  # a fifth of four decimals ends after five


def illuminants() -> bytes:
    header = {
        "name": "CIE standard illuminant D65 and CIE daylight illuminant D60",
        "publication": "CIE 15:2004, table T.1 (D65); D series at 6000 K × 1.4388/1.438 (D60)",
        "source": f'{PACKAGE}, colour.SDS_ILLUMINANTS["D65"], ["D60"]',
        **PROVENANCE,
        "derived": "linear interpolation from 5 nm to 1 nm",
    }
    return csv(header, {"d65": illuminant("D65"), "d60": illuminant("D60")})


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--check", action="store_true", help="compare instead of writing")
    check = parser.parse_args().check

    contents = {"observer_1931_2deg.csv": observer(), "illuminants.csv": illuminants()}
    return compare(OUTPUT, contents) if check else write(OUTPUT, contents)


if __name__ == "__main__":
    sys.exit(main())
