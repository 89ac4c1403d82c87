#!/usr/bin/env bash
# Builds the wheel, installs it into a fresh environment and runs a design from there. Skipped, with a line that says so, where Python or what
# builds the wheel cannot be had.
set -euo pipefail
cd "$(dirname "$0")/.."
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
if ! python3 -m venv "$place/build" || ! "$place/build/bin/pip" install -q "maturin>=1.9,<2"; then
    echo "wheel: skipped, Python's venv or maturin could not be had"
    exit 0
fi
"$place/build/bin/maturin" build --release --quiet --out "$place/wheels"
wheel=$(ls "$place"/wheels/*.whl)
size=$(stat -c %s "$wheel")
[ "$size" -lt 10000000 ] || { echo "wheel: $size bytes, more than 10 MB"; exit 1; }
python3 -m venv "$place/use"
"$place/use/bin/pip" install -q --no-index "$wheel"
cp designs/small_net.yaml "$place/"
(cd "$place" && use/bin/barrier-check small_net.yaml --seeds 5 > told && use/bin/barrier-check explain wall_sliding > /dev/null)
[ -s "$place/out/small_net/report.html" ]
echo "wheel: $(basename "$wheel"), $size bytes, installed and run"
