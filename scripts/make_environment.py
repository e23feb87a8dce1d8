"""Write assets/environments/*.hdr: small environment lights from CC0 panoramas of Poly Haven.

    npm pack @pmndrs/assets@1.7.0 && tar xzf pmndrs-assets-1.7.0.tgz
    python scripts/make_environment.py package            write the files
    python scripts/make_environment.py package --check    compare; exit 1 if anything differs

The package holds equirectangular panoramas of 512×256 pixels as OpenEXR in base64. They become
Radiance pictures of 256×128, each pixel the mean of four: linear Rec.709, y up, looking at the
centre. DWAB compression has left a few negative values beside lamps; they become 0.
"""

import argparse
import base64
import json
import re
import sys
import tempfile
from pathlib import Path

import numpy as np
import OpenEXR

from generated import compare, write

OUTPUT = Path(__file__).resolve().parent.parent / "assets" / "environments"
VERSION = "1.7.0"
WIDTH = 256
# By name in the package: a sunlit empty room, a photo studio, a city square under cloud.
PANORAMAS = ("apartment", "studio", "city")


def panorama(package: Path, name: str) -> np.ndarray:
    """Linear RGB, height × width × 3."""
    module = (package / "hdri" / f"{name}.exr.js").read_text("ascii")
    encoded = re.search(r"base64,([A-Za-z0-9+/=]+)", module).group(1)
    with tempfile.NamedTemporaryFile(suffix=".exr") as file:
        file.write(base64.b64decode(encoded))
        file.flush()
        channels = OpenEXR.File(file.name).channels()
    return channels["RGB"].pixels.astype(np.float64)


def box_filtered(pixels: np.ndarray, width: int) -> np.ndarray:
    """Means over squares of pixels."""
    height, original_width, _ = pixels.shape
    size = original_width // width
    return pixels.reshape(height // size, size, width, size, 3).mean((1, 3))


def rgbe(pixels: np.ndarray) -> np.ndarray:
    """Three 8-bit mantissas and a shared exponent per pixel (Ward 1991), rounded to nearest."""
    largest = pixels.max(-1)
    mantissa, exponent = np.frexp(largest)
    # A mantissa that would round up to 256 needs the next exponent.
    exponent += mantissa >= 255.5 / 256
    mantissas = np.rint(np.ldexp(pixels, 8 - exponent[..., None]))
    encoded = np.concatenate([mantissas, exponent[..., None] + 128], -1)
    return np.where(largest[..., None] < 1e-32, 0, encoded).astype(np.uint8)


def run_length(values: bytes) -> bytes:
    """One channel of one scan line: (128 + length, value) or (length, values…)."""
    encoded, literal = bytearray(), bytearray()

    def flush() -> None:
        for start in range(0, len(literal), 128):
            part = literal[start : start + 128]
            encoded.extend([len(part), *part])
        literal.clear()

    for run in re.finditer(rb"(.)\1{0,126}", values, re.S):
        length = len(run.group())
        if length < 4:
            literal.extend(run.group())
        else:
            flush()
            encoded.extend([128 + length, run.group()[0]])
    flush()
    return bytes(encoded)


def radiance(pixels: np.ndarray) -> bytes:
    """A Radiance picture with run-length encoded scan lines."""
    height, width, _ = pixels.shape
    header = f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n".encode()
    lines = [
        bytes([2, 2, width >> 8, width & 255])
        + b"".join(run_length(channel.tobytes()) for channel in line.T)
        for line in rgbe(pixels)
    ]
    return header + b"".join(lines)


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("package", type=Path, help="the unpacked npm package @pmndrs/assets")
    parser.add_argument("--check", action="store_true", help="compare instead of writing")
    arguments = parser.parse_args()

    found = json.loads((arguments.package / "package.json").read_text("utf-8"))["version"]
    if found != VERSION:
        parser.error(f"version {VERSION} of @pmndrs/assets is wanted, this is {found}")
    contents = {
        f"{name}.hdr": radiance(box_filtered(panorama(arguments.package, name), WIDTH).clip(0))
        for name in PANORAMAS
    }
    return compare(OUTPUT, contents) if arguments.check else write(OUTPUT, contents)


if __name__ == "__main__":
    sys.exit(main())
