#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# An entry is run, judged and drawn; its full run has the settings of full.txt, where the run file is run.yaml,
# and those of the point's own, which win. Takes the program.
set -eu
perrin=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
entry=$folder/gallery/gas
mkdir -p "$entry"
cd "$folder"

cat > gallery/style.gp <<'END'
set terminal svg
set output "figure.svg"
set datafile separator ","
END
cat > "$entry/run.yaml" <<'END'
system: {dimension: 2, particles: 30, packing_fraction: 0.01, species: {disc: {shape: disc}}}
dynamics: {method: newtonian}
protocol: [{stage: flight, time: 20, observe: [pressure]}]
ensemble: {replicas: 2, seed: 1}
END
cp "$entry/run.yaml" "$entry/other.yaml"
echo '# A tiny gas' > "$entry/README.md"
printf '# More samples.\nensemble.replicas=3\n' > "$entry/full.txt"
cat > "$entry/points.csv" <<'END'
point,curve,x,settings,run_file,full
plain,gas,1,,,
own,gas,2,protocol.flight.time=30,,ensemble.replicas=4
other,gas,3,,other.yaml,
other_own,gas,4,,other.yaml,ensemble.replicas=5
END
printf 'measure,quantity\nZ,flight/compressibility_factor\n' > "$entry/measures.csv"
cat > "$entry/expected.csv" <<'END'
subject,measure,expected,uncertainty,tolerance,precision,kind,source
plain,Z,1.02,0,0.1,,exact,"second virial coefficient"
END
printf 'load "style.gp"\nplot "measured.csv" using 3:5\n' > "$entry/figure.gp"

failed=0
replicas() { # RUN POINT EXPECTED
    said=$(awk -F, -v point="$2" '$1 == point { print $7 }' "out/$1/measured.csv")
    [ "$said" = "$3" ] || { echo "$1, $2: expected $3 replicas, found $said"; failed=1; }
}
"$perrin" reproduce gas -o out > said.txt 2>&1 || { cat said.txt; exit 1; }
"$perrin" reproduce gas --full -o out > said.txt 2>&1 || { cat said.txt; exit 1; }
for point in plain own other other_own; do replicas gas "$point" 2; done
replicas gas-full plain 3
replicas gas-full own 4
replicas gas-full other 2
replicas gas-full other_own 5
for run in gas gas-full; do
    grep -q ',met,' "out/$run/verdict.csv" || { echo "$run: no verdict"; failed=1; }
    [ -s "out/$run/figure.svg" ] || { echo "$run: no figure"; failed=1; }
done

# What is told in the end is of the entry that missed, not of what others looked for in vain.
cp -r "$entry" gallery/dense
sed -i 's/1\.02,0,0\.1/2,0,0.1/' "$entry/expected.csv"
echo 'sweep: {system.packing_fraction: [0.01, 0.02]}' >> gallery/dense/run.yaml
printf 'point,curve,x,settings\nplain,gas,1,\n' > gallery/dense/points.csv
printf 'measure,quantity\nZ,"flight/compressibility_factor[0.01]"\n' > gallery/dense/measures.csv
code=0
"$perrin" reproduce gas dense -o out > said.txt 2>&1 || code=$?
[ $code = 70 ] || { echo "missed: exit code $code"; failed=1; }
grep -q '^perrin: error: gas: 1 of 1 values are not what is expected$' said.txt ||
    { cat said.txt; failed=1; }
exit $failed
