#!/usr/bin/env bash
# Builds Edgewise for any processor and for this machine's own, lets both measure their kernels in turn, and writes
# the shortest times side by side as CSV: kernel,kind,per,stock_ns,native_ns. Says the middle ratio of our kernels.
#
#   scripts/compare_builds.sh OUT.csv [TURNS]
#
# Binaries that are there already are given as STOCK and NATIVE, and nothing is built.
set -euo pipefail
cd "$(dirname "$0")/.."
out=${1:?"usage: scripts/compare_builds.sh OUT.csv [TURNS]"}
turns=${2:-3}
folder=target/builds
mkdir -p "$folder"

if [ -z "${STOCK:-}" ]; then
    STOCK=target/release/edgewise
    cargo build --quiet --release --no-default-features --features cli
fi
if [ -z "${NATIVE:-}" ]; then
    NATIVE=target/native/release/edgewise
    RUSTFLAGS="-C target-cpu=native" \
        cargo build --quiet --release --no-default-features --features cli --target-dir target/native
fi

for turn in $(seq "$turns"); do
    for build in stock native; do
        binary=$STOCK
        [ "$build" = native ] && binary=$NATIVE
        echo "turn $turn of $turns: $build" >&2
        "$binary" study speed --format csv >"$folder/$build.$turn.csv"
    done
done

python3 - "$folder" "$out" <<'PYTHON'
import csv, statistics, sys
from pathlib import Path

folder, out = map(Path, sys.argv[1:])
shortest = {}
for build in ("stock", "native"):
    for path in folder.glob(f"{build}.*.csv"):
        for row in csv.DictReader(path.open()):
            times = shortest.setdefault((row["kernel"], row["kind"], row["per"]), {})
            times[build] = min(times.get(build, float("inf")), float(row["min_ns"]))
with out.open("w", newline="") as file:
    writer = csv.writer(file)
    writer.writerow(["kernel", "kind", "per", "stock_ns", "native_ns"])
    writer.writerows([*name, times["stock"], times["native"]] for name, times in shortest.items())
ratios = [times["stock"] / times["native"] for (_, kind, _), times in shortest.items() if kind == "ours"]
print(f"stock ÷ native over our kernels: middle {statistics.median(ratios):.3f}, largest {max(ratios):.3f}", file=sys.stderr)
PYTHON
