#!/usr/bin/env bash
# Runs the throughput bench and LAMMPS in turn on the same states of equal spheres; prints ns per sphere-step of both.
# Needs `lmp` (Debian: apt-get install lammps). Usage: benches/peers/compare.sh [rounds]
set -euo pipefail
cd "$(dirname "$0")/../.."
rounds=${1:-2}
states=target/bench_states
ours=$(cargo bench --bench throughput --no-run --message-format=json 2>/dev/null | sed -n 's/.*"executable":"\([^"]*throughput[^"]*\)".*/\1/p' | tail -1)
export OMP_NUM_THREADS=1 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

# A dump as a LAMMPS data file.
data_file() { # state count copies scaled
    awk -v n="$2" -v c="$3" -v m="$4" '
        BEGIN { s = (m / 5406) ^ (1 / 3)
            printf "spheres\n\n%d atoms\n1 atom types\n0 %.12g xlo xhi\n0 %.12g ylo yhi\n0 %.12g zlo zhi\n\nAtoms\n\n", n, 2.19 * s, 0.30 * s * c, 1.2 * s }
        /ITEM: ATOMS/ { rows = 1; next }
        rows { printf "%s 1 0.01527 2701. %s %s %s\n", $1, $2, $3, $4; v[++k] = $1 " " $5 " " $6 " " $7 " " $8 " " $9 " " $10 }
        END { print "\nVelocities\n"; for (i = 1; i <= k; i++) print v[i] }' "$states/$1.dump" > "$states/$1.data"
}

for phase in dense flow; do
    for count in 5406 20000 100000; do
        state=${phase}_$count
        copies=$((count > 20000 ? count / 20000 : 1))
        scaled=$((count > 20000 ? 20000 : count))
        steps=$((16000000 / count))
        for ((round = 1; round <= rounds; round++)); do
            mine=$("$ours" --one "$state" | awk '{ print $1 }')
            [ -f "$states/$state.data" ] || data_file "$state" "$count" "$copies" "$scaled"
            theirs=$(lmp -in benches/peers/spheres.lmp -log none -var STATE "$states/$state.data" -var COUNT "$count" \
                -var SCALED "$scaled" -var COPIES "$copies" -var GATE "$([ $phase = dense ] && echo 1 || echo 0)" \
                -var SKIN "$([ $phase = dense ] && echo 0.0015 || echo 0.003)" -var STEPS "$steps" |
                awk -v n="$count" '/^Loop time/ { t = $4; s = $9 } END { printf "%.1f", t / s / n * 1e9 }')
            awk -v s="$state" -v a="$mine" -v b="$theirs" 'BEGIN { printf "%-14s ours %6.1f  LAMMPS %6.1f ns per sphere-step  ratio %.2f\n", s, a, b, a / b }'
        done
    done
done
