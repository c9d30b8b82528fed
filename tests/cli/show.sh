#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# What `show` and `report` make of a run, as a reader sees it: the same numbers in the table, as
# CSV and as JSON; a page that needs nothing else. show.sh PERRIN
. "$(dirname "$0")/scratch.sh"

cat > small.yaml << 'END'
title: 5 < 7 & "so on"
system:
  dimension: 2
  particles: 40
  packing_fraction: 0.3
  species: {light: {shape: disc, fraction: 0.5}, heavy: {shape: disc, mass: 4, fraction: 0.5}}
dynamics: {method: event-driven, thermostat_interval: 0.05}
protocol:
  - {stage: rest, time: 0.2, observe: [mean_squared_displacement, pressure, snapshot]}
ensemble: {replicas: 3}
END
"$perrin" run small.yaml --quiet --threads 1 || exit 1

failed=0
count=0
# expect SENTENCE COMMAND...: the command succeeds
expect() {
    sentence=$1
    shift
    count=$((count + 1))
    "$@" > out 2> err && return
    failed=$((failed + 1))
    printf 'FAILED: %s\n' "$sentence"
    head -5 out err
}
lacks() { ! grep -q "$@"; }

# A measure of whether the halves of a stage agree is one that its method can observe.
halves() {
    sed "s/^  species:.*/  species: {$2}/; s/^dynamics:.*/dynamics: {method: $3}/
         s/observe:.*/observe: [snapshot]}/; s/dimension: 2/dimension: $4/" small.yaml > halves.yaml
    expect "check advises to observe $1" \
        sh -c "'$perrin' check halves.yaml | grep -q 'whether its halves agree ($1)'"
}
halves pressure 'light: {shape: disc, fraction: 1}' 'event-driven, thermostat_interval: 0.05' 2
halves acceptance 'ball: {shape: sphere, fraction: 1}' 'dynamic-monte-carlo, step: 0.05' 3
halves energy 'soft: {shape: soft-sphere, exponent: 36, fraction: 1}' \
    'dynamic-monte-carlo, step: 0.05' 3
halves structure_factor \
    'small: {shape: sphere, fraction: 0.5}, big: {shape: sphere, diameter: 1.2, fraction: 0.5}' \
    'dynamic-monte-carlo, step: 0.05, clock: acceptance-rescaling' 3

# A measured clock has an error; a stage that does not observe it is said not to tell it.
unseen() { "$perrin" check halves.yaml "$@" | grep -q 'not told: what a cycle was worth'; }
seen() { "$perrin" check halves.yaml "$@" > /dev/null && ! unseen "$@"; }
expect "check says that the clock is not told" unseen
sed -i 's/observe:.*/observe: [acceptance, snapshot]}/' halves.yaml
expect "check has nothing to say where it is" seen

# Of a tracer with trajectories one after another, whether there will be another place for it.
cat > pulled.yaml << 'END'
system:
  dimension: 3
  particles: 4000
  packing_fraction: 0.45
  box: {aspect: [2, 1, 1]}
  species: {bath: {shape: sphere}, tracer: {shape: sphere, diameter: 1.6, count: 1}}
dynamics: {method: dynamic-monte-carlo, step: 0.03, clock: acceptance-rescaling}
protocol:
  - {stage: pulled, time: 1, pull: {species: tracer, peclet: 2, period: 0.5}}
END
warns() { "$perrin" check pulled.yaml "$@" | grep -q 'or the$'; }
keeps_quiet() { "$perrin" check pulled.yaml "$@" > /dev/null && ! warns "$@"; }
expect "check warns of a dense bath" warns
expect "check does not of a small tracer" keeps_quiet --set system.species.tracer.diameter=0.3
expect "check does not of one like the bath" keeps_quiet --set system.species.tracer.diameter=1
expect "check does not of a single trajectory" \
    keeps_quiet --set protocol.pulled.pull.period=0

# A time that was meant otherwise costs more than anybody has.
costs() { "$perrin" check small.yaml "$@" | grep -q "warning: more than 30 days, most of it for stage 'rest'"; }
costs_little() { "$perrin" check small.yaml "$@" > /dev/null && ! costs "$@"; }
expect "check warns of what nobody waits for" costs --set protocol.rest.time=1e12
expect "check does not of what takes no time" costs_little

# Of waiting times, whether all lags end within the stage.
waits() {
    last=$1
    shift
    sed "s/observe:.*/observe: [{mean_squared_displacement: {waiting_times: [0, 0.1], times: {last: $last}}}]}/" \
        small.yaml > waits.yaml
    "$perrin" check waits.yaml "$@" | grep -q 'where the waiting time is 0.1: they end after the stage'
}
waits_in_vain() { ! waits "$@" && "$perrin" check waits.yaml > /dev/null; }
expect "check warns of lags beyond the stage" waits 0.15
expect "check does not of those within" waits_in_vain 0.1
expect "check does not of a longer stage" waits_in_vain 0.15 --set protocol.rest.time=0.25

# Of a pulled tracer diffusion is told across the force alone, along which it drifts.
sed 's/particles: 4000/particles: 200/; s/0.45/0.05/; s/diameter: 1.6, //; /^dynamics/d; /stage:/d' pulled.yaml > forced.yaml
cat >> forced.yaml << 'END'
  - {stage: pulled, time: 1, pull: {species: tracer, peclet: 2, axis: y}, observe: [mean_squared_displacement]}
dynamics: {method: event-driven, thermostat_interval: 0.1}
ensemble: {replicas: 2}
END
sed -i 's/aspect: \[2, 1, 1\]/aspect: [1, 2, 1]/' forced.yaml
"$perrin" run forced.yaml --quiet --threads 1 || exit 1
expect "the force is told" sh -c "'$perrin' show forced | grep -q '^pulled/force_y  *4 '"
for name in x_tracer z_tracer x z; do
    expect "and diffusion across it: $name" \
        sh -c "'$perrin' show forced | grep -q '^pulled/short_time_diffusion_$name '"
done
for name in '' _tracer _bath _y _y_tracer _total; do
    expect "and none along it: $name" \
        sh -c "'$perrin' show forced | grep -q . && ! '$perrin' show forced | grep -q 'time_diffusion$name '"
done

# Of a strongly pulled tracer, what a long trial makes of the friction, and where it runs away.
of_step() { # WORDS SETTINGS...
    words=$1
    shift
    "$perrin" check pulled.yaml --set protocol.pulled.pull.period=0 \
        --set system.species.tracer.diameter=1 --set protocol.pulled.pull.peclet=50 "$@" > told &&
        grep -q "$words" told
}
not_of_step() { ! of_step "$@" && grep -q . told; }
exact=protocol.pulled.pull.clock=exact-force
expect "check says how far a drifted trial is off" of_step 'some 10 % too large' --set dynamics.step=0.01
expect "and one of exact mean" of_step 'some 8 % too small' --set dynamics.step=0.008 --set $exact
expect "of a short one it says nothing" not_of_step '% too' --set dynamics.step=0.003 --set $exact
expect "nor of a weak force" not_of_step '% too' --set dynamics.step=0.04 --set $exact \
    --set protocol.pulled.pull.peclet=15
expect "a longer drifted one runs away" of_step "keep the bath's pace" --set dynamics.step=0.04
expect "of which it is not said how far it is off" not_of_step '% too' --set dynamics.step=0.04
expect "check says below which friction a trajectory ends before its time" \
    of_step "a friction below [1-9].* ends before its time" --set dynamics.step=0.003
expect "of one that cannot go so far it does not" \
    not_of_step "before its time" --set protocol.pulled.pull.peclet=1
expect "check says that the trajectories of one replica give errors" \
    sh -c "'$perrin' check pulled.yaml --set ensemble.replicas=1 | grep -q 'but of how the tracer goes'"
expect "check says which calibration leads it into its own wake" \
    of_step "own wake.*calibration = [1-9].*would not" --set dynamics.step=0.01 --set dynamics.calibration=20000
expect "of a short one it does not" \
    not_of_step "own wake" --set dynamics.step=0.01 --set dynamics.calibration=4000

# Numbers.
"$perrin" show small > table
"$perrin" show small --csv > table.csv
for quantity in $(tail -n +2 table.csv | cut -d, -f1 | grep '^rest/'); do
    expect "what $quantity is can be asked without a run" \
        sh -c "'$perrin' explain ${quantity#*/} | grep -q ."
done
expect "every quantity of the table stands in the CSV, in the same order" \
    sh -c "sed -n '2,/^\$/p' table | awk 'NF {print \$1}' > a &&
           sed 1d table.csv | cut -d, -f1 > b && test -s a && cmp a b"
expect "what is said of a quantity is said once in the table of all" \
    test "$(grep -c 'Largest <r^2>' table)" = 1
expect "asked alone, a quantity says what it is" \
    sh -c "'$perrin' show small short_time_diffusion_heavy | grep 'Largest <r^2>'"
expect "a part of a name finds its quantity" \
    sh -c "'$perrin' show small quanity 2>&1 | grep 'lists them' &&
           '$perrin' show small displ 2>&1 | grep 'did you mean rest/.*displacement'"
expect "the points of a series are as many as its axes say" \
    sh -c "'$perrin' show small rest/snapshot --csv | sed 1d | wc -l | grep -x ' *200'" # 40 particles, 5 columns
expect "CSV is one table, where a number has the name of a series as well" \
    sh -c "'$perrin' show small rest/pressure --csv | awk -F, 'NF != 5 {exit 1}'"
expect "results.h5 may be named itself" \
    sh -c "'$perrin' show small/results.h5 --csv | cmp - table.csv"
expect "free heavy particles diffuse at most a quarter as fast" \
    sh -c "awk -F, '/short_time_diffusion_heavy/ && \$2 > 0 && \$2 < 0.25 {good = 1}
           END {exit !good}' table.csv"

# JSON, where something can read it.
if command -v python3 > /dev/null; then
    "$perrin" show small --json > all.json
    expect "the JSON holds the numbers of the CSV and rectangular series" python3 -c '
import csv, json
results = json.load(open("all.json"))
rows = list(csv.DictReader(open("table.csv")))
assert [row["quantity"] for row in rows] == list(results["quantities"])
for row in rows:
    value = results["quantities"][row["quantity"]]["value"]
    assert value is None or value == float(row["value"]), row
def shape(nest):
    return [len(nest)] + shape(nest[0]) if isinstance(nest, list) else []
for series in results["series"].values():
    lengths = [len(series[axis]) for axis in series["axes"]]
    assert shape(series["mean"]) == shape(series["error"]) == lengths, lengths
assert results["run"]["title"] == "5 < 7 & \"so on\""
'
fi

# The page.
page=small/report.html
expect "the page has the title, escaped" grep -q '<h1>5 &lt; 7 &amp; &quot;so on&quot;</h1>' $page
expect "the page says what was simulated" \
    grep -q '40 particles in 2 dimensions, packing fraction 0.3: 20 light of diameter 1, 20 heavy' $page
expect "the page says how" grep -q 'rest: event-driven, 0.2 d²/D₀' $page
expect "the page loads nothing" lacks -E '(src|href)="?(http|//|file)|@import|<script|<link' $page
expect "the page has a figure or says why not" grep -q '<svg' $page
cp $page before.html
expect "written again, the page is the same" sh -c "'$perrin' report small && cmp before.html $page"

expect "and its sentence is that of the table" \
    sh -c "'$perrin' explain long_time_diffusion | grep -q 'Slope of <r^2>/(2 dim) against t'"

# A sweep over rates, whose windows of strain differ; the flow of one of them from a file as well.
sed -e '/^protocol/,$d' small.yaml > flow.yaml
cat >> flow.yaml << 'END'
protocol:
  - {stage: flow, shear_rate: 1, time: 0.2, observe: [stress]}
ensemble: {replicas: 2}
END
sed 's/shear_rate: 1,/shear_table: {file: rates.csv},/' flow.yaml > ramp.yaml
printf '0, 2\n' > rates.csv
echo 'sweep: {protocol.flow.shear_rate: [1, 2]}' >> flow.yaml
# The pressure is a number as well as a series of blocks.
sed -e '/^protocol/,$d' small.yaml > dense.yaml
cat >> dense.yaml << 'END'
protocol:
  - {stage: rest, time: 0.2, observe: [pressure]}
ensemble: {replicas: 2}
sweep: {system.packing_fraction: [0.2, 0.3]}
END
"$perrin" run flow.yaml --quiet --threads 1 && "$perrin" run ramp.yaml --quiet --threads 1 || exit 1
expect "what could not be laid side by side is named" \
    sh -c "'$perrin' show flow | grep '^not side by side, .*: flow/stress\$'"
expect "what is swept has its unit" sh -c "'$perrin' show flow | grep -qF 'shear_rate [D0/d^2]'"
expect "and on the page" grep -q 'not side by side.*flow/stress' flow/report.html
expect "under the figure, too" grep -q 'Only of points of the sweep' flow/report.html
# How long it waits is swept, and the stress has an axis of time, too; and its replicas are called so.
sed -e '/^protocol/,$d' small.yaml > age.yaml
cat >> age.yaml << 'END'
protocol:
  - {stage: rest, time: 0.1}
  - {stage: later, time: 0.1, observe: [stress]}
ensemble: {replicas: 2}
sweep: {protocol.rest.time: [0.1, 0.2], ensemble.replicas: [2, 3]}
END
"$perrin" run dense.yaml --quiet --threads 1 && "$perrin" run age.yaml --quiet --threads 1 || exit 1
expect "of a key that a series has as an axis the whole is said" \
    sh -c "'$perrin' show age | grep -q '^later/stress  *protocol.rest.time (2) x ensemble.replicas (2) x stress ([34]) x time ('"
expect "a number that all points have is told as such" lacks 'not side by side' dense/report.html
expect "and its figure says nothing else" lacks 'Only of points of the sweep' dense/report.html
expect "rates from a file are those that they say" \
    sh -c "'$perrin' show flow/shear_rate=2 shear_stress --csv | cut -d, -f2 > a &&
           '$perrin' show ramp shear_stress --csv | cut -d, -f2 > b && test -s a && cmp a b"
# Of a table, its numbers; of a long one, its ends.
expect "the results tell the rates" sh -c \
    "'$perrin' show ramp --json | grep -q 'stages.*shear_table = {times: \[0\], rates: \[2\]}'"
printf '%s, %s\n' 0 1 0.01 2 0.02 3 0.03 4 0.04 5 0.05 6 0.2 -7 > rates.csv
expect "check tells the ends of a long table" sh -c "'$perrin' check ramp.yaml | grep -q \
    'driven by  *shear_table = {times: \[0, 0.01, 0.02, 0.03, ..., 0.2\], rates: \[1, 2, 3, 4, ..., -7\]}\$'"

printf 'show: %d tests, %d failed\n' "$count" "$failed"
test "$failed" = 0
