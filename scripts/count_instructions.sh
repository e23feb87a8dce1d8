#!/usr/bin/env bash
# Counts the instructions of one evaluation of our kernels on AVX2 in a simulator, which no clock and no neighbour
# disturbs, and writes them as CSV: kernel,per,instructions.
#
#   scripts/count_instructions.sh OUT.csv
#
# A binary that is there already is given as STOCK, and nothing is built.
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/packages.sh
out=${1:?"usage: scripts/count_instructions.sh OUT.csv"}
require_packages valgrind

if [ -z "${STOCK:-}" ]; then
    STOCK=target/release/edgewise
    cargo build --quiet --release --no-default-features --features cli
fi

# instructions KERNEL PER TURNS : of the whole program, and how many evaluations it made.
instructions() {
    local report evaluations
    report=$(mktemp)
    evaluations=$(RAYON_NUM_THREADS=1 valgrind --tool=cachegrind --cache-sim=no --cachegrind-out-file=/dev/null \
        --log-file="$report" "$STOCK" study speed --instruction-set avx2 --repeat "$1" "$2" "$3")
    sed -n 's/.*I *refs: *//p' "$report" | tr -d ', '
    echo "$evaluations"
    rm -f "$report"
}

mkdir -p "$(dirname "$out")"
{
    echo "kernel,per,instructions"
    while read -r kernel per; do
        echo "counting $kernel per $per" >&2
        read -r -d '' few few_evaluations < <(instructions "$kernel" "$per" 50) || true
        read -r -d '' many many_evaluations < <(instructions "$kernel" "$per" 150) || true
        awk -v i=$((many - few)) -v n=$((many_evaluations - few_evaluations)) \
            -v name="$kernel,$per" 'BEGIN { printf "%s,%.4f\n", name, i / n }'
    done <<'KERNELS'
schlick material
hoffman material
hoffman-basis material
f82-tint material
conductor material
conductor-any material
conductor-and-absorption material
conductor-and-absorption-any material
dielectric material
spectral-31 material
schlick pixel
hoffman pixel
hoffman-basis pixel
f82-tint pixel
conductor pixel
lab color
delta-e pair
KERNELS
} >"$out.part"
mv "$out.part" "$out"
