#!/usr/bin/env bash
# Runs the ropes and ring nets of nets.json in this engine and in Kratos Multiphysics in turn, each on one thread; prints a table in
# Markdown with the figures of both, the ratio ours over Kratos, and the time of both (the solution alone, without starting the program or
# building the scene; a net at rest is found by damped steps here and by Newton's method there, a net that is hit takes the same steps in both).
# Installs Kratos (Python packages, 3.9 to 3.13) into target/kratos on first use.
# Usage: benches/peers/nets.sh
set -euo pipefail
cd "$(dirname "$0")/../.."
target=${CARGO_TARGET_DIR:-target}
kratos=$target/kratos
version=10.4.4
export OMP_NUM_THREADS=1
if [ ! -x "$kratos/bin/python" ]; then
    python3 -m venv "$kratos"
    "$kratos/bin/pip" install --quiet KratosMultiphysics==$version KratosStructuralMechanicsApplication==$version KratosCableNetApplication==$version
fi
ours=$(cargo bench --bench nets --no-run --message-format=json | sed -n 's/.*"executable":"\([^"]*nets[^"]*\)".*/\1/p' | tail -1)
"$ours" benches/peers/nets.json > "$target/nets_ours.jsonl"
# Kratos greets on the same output; rows begin with a brace.
"$kratos/bin/python" benches/peers/nets.py benches/peers/nets.json | grep '^{' > "$target/nets_kratos.jsonl"
python3 - "$target/nets_ours.jsonl" "$target/nets_kratos.jsonl" << 'TABLE'
import json
import sys

ours, theirs = ([json.loads(row) for row in open(path)] for path in sys.argv[1:])
print("| scene | quantity | ours | Kratos | ratio | time of ours (s) | time of Kratos (s) |")
print("| --- | --- | --- | --- | --- | --- | --- |")
for mine, other in zip(ours, theirs, strict=True):
    assert mine["scene"] == other["scene"]
    row = [mine["scene"], f"{mine['time']:.4f}", f"{other['time']:.4f}"]
    for name in mine["found"] | other["found"]:
        both = [found["found"].get(name) for found in (mine, other)]
        figures = ["not found" if value is None else f"{value:.5g}" for value in both]
        ratio = f"{both[0] / both[1]:.4f}" if None not in both and both[1] else "-"
        print("|", " | ".join([row[0], name, *figures, ratio, *row[1:]]), "|")
        row = ["", "", ""]
TABLE
