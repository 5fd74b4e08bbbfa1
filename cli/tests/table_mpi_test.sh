#!/bin/sh
# Four ranks write the bytes that one process writes. Arguments: the command hts, mpirun.
set -e
hts=$1
mpirun=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat > al.json <<'JSON'
{"name": "rough aluminium", "model": "he", "rms_roughness_um": 0.28, "correlation_length_um": 1.77, "index": "Al"}
JSON
build="table build --material al.json --wavelengths 0.5,0.6 --tolerance 0.03 --output"
$hts $build one.htst
OMP_NUM_THREADS=1 $mpirun --allow-run-as-root --oversubscribe -n 4 "$hts" $build four.htst
cmp one.htst four.htst
test "$(ls)" = "al.json
four.htst
one.htst"
