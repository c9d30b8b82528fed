#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# What `analyse` measures from trajectories: the numbers of the run itself, bit for bit, where it
# sees the same configurations; other observables with other settings; and what it says where it
# cannot. analyse.sh PERRIN
. "$(dirname "$0")/scratch.sh"

# A step is 0.00125 d^2/D0, of which every one is stored, and no lag is shorter.
cat > run.yaml << 'END_OF_FILE'
system:
  dimension: 2
  particles: 60
  packing_fraction: 0.5
  species: {small: {shape: disc, fraction: 0.5}, big: {shape: disc, diameter: 1.4, fraction: 0.5}}
dynamics: {method: event-driven, thermostat_interval: 0.05}
protocol:
  - {stage: settle, dynamics: {method: newtonian}, time: 1}
  - stage: measured
    time: 0.75
    observe:
      - mean_squared_displacement: {times: {first: 0.00125, last: 0.25}}
      - self_scattering: {times: {first: 0.00125, last: 0.25}, wave_numbers: [2, 6]}
      - collective_scattering: {times: {first: 0.00125, last: 0.25}, wave_numbers: [2, 6]}
      - non_gaussian_parameter: {times: {first: 0.00125, last: 0.25}}
      - van_hove: {times: {first: 0.00125, last: 0.25}, waiting_times: [0, 0.1, 0.3]}
      - overlap: {times: {first: 0.00125, last: 0.25}}
      - pair_distribution: {distances: {last: 3}}
      - structure_factor
      - snapshot
ensemble: {replicas: 2}
output: {trajectory: {every: 0.00125, stage: measured}}
END_OF_FILE
"$perrin" run run.yaml --quiet --threads 1 || exit 1

failed=0
fail() {
    failed=$((failed + 1))
    printf 'FAILED: %s\n' "$1"
}
numbers() { "$perrin" show "$1" --json | sed '/"run": {/,/^  }/d'; }
says() { # SENTENCE COMMAND...: it fails and says so
    sentence=$1
    shift
    "$@" > out 2>&1 && fail "succeeded: $*"
    grep -q "$sentence" out || { fail "$*: $(cat out)"; }
}

"$perrin" analyse run > out || fail "analyse run"
numbers run > live.json
numbers run/analysis > stored.json
grep -q collective_scattering_normalised live.json || fail "the run has no correlators"
cmp live.json stored.json || fail "the same configurations gave other numbers"

# Under shear too: wave vectors and displacements that go with the flow, and where pairs touch; and at rest
# in the box that a flow has left leaning.
cat > sheared.yaml << 'END_OF_FILE'
system:
  dimension: 2
  particles: 60
  packing_fraction: 0.5
  species: {small: {shape: disc, fraction: 0.5}, big: {shape: disc, diameter: 1.4, fraction: 0.5}}
dynamics: {method: event-driven, thermostat_interval: 0.05}
protocol:
  - stage: flow
    shear_rate: 2
    strain: 1.5
    observe:
      - self_scattering: {times: {first: 0.00125, last: 0.25}, waiting_strain: [0, 0.1, 0.7]}
      - advected_scattering: {times: {first: 0.00125, last: 0.25}, waiting_strain: [0, 0.1, 0.7]}
      - non_affine_displacement: {times: {first: 0.00125, last: 0.25}}
      - planar_structure_factor
      - angular_pair_distribution
      - contact_stress
  - stage: rest
    time: 0.05
    observe: [structure_factor, collective_scattering: {times: {first: 0.00125}}]
ensemble: {replicas: 2}
output: {trajectory: {every: 0.00125}}
END_OF_FILE
"$perrin" run sheared.yaml --quiet --threads 1 || exit 1
"$perrin" analyse sheared > out || fail "analyse sheared"
numbers sheared > live.json
numbers sheared/analysis > stored.json
grep -q advected_scattering_normalised live.json || fail "the flow has no correlators"
cmp live.json stored.json || fail "the same configurations of a flow gave other numbers"

# Two stages, of which the second goes on from the last frame of the first, and frames that are
# further apart than the shortest lags of the run: the lags that both have are the same bits.
cat > two.yaml << 'END_OF_FILE'
system: {dimension: 3, particles: 60, packing_fraction: 0.2, species: {ball: {shape: sphere}}}
dynamics: {method: event-driven, thermostat_interval: 0.05}
protocol:
  - {stage: before, time: 0.25}
  - {stage: after, time: 1, observe: [self_scattering: {times: {first: 0.0125, last: 0.25}, origins: 20}]}
ensemble: {replicas: 1}
output: {trajectory: {every: 0.0125}}
END_OF_FILE
"$perrin" run two.yaml --quiet --threads 1 || exit 1
"$perrin" analyse two > out || fail "analyse two"
for directory in two two/analysis; do
    "$perrin" show $directory --csv after/self_scattering | grep -E ',(0.0125|0.025|0.25),' > csv
    [ "$(wc -l < csv)" -ge 20 ] || fail "there are not so many lags in $directory"
    cksum < csv
done | uniq | wc -l | grep -qx 1 || fail "the same lags have other numbers"

# Monte Carlo moves the particles before a stage begins, so that its start is no frame.
sed -e 's/event-driven.*}/dynamic-monte-carlo, step: 0.05}/' two.yaml > moved.yaml
"$perrin" run moved.yaml --quiet --threads 1 || exit 1
says 'no configuration at the very start' "$perrin" analyse moved

"$perrin" analyse run 'overlap: {distance: 0.1}' velocity_distribution > out 2>&1 &&
    fail "velocities from a trajectory"
"$perrin" analyse run -o other overlap 'self_scattering: {wave_numbers: [3], times: {last: 0.1}}' \
    > out || fail "analyse with other settings"
"$perrin" show other --csv measured/overlap > csv || fail "overlap was not measured"
"$perrin" show other --csv measured/self_scattering > csv || fail "self_scattering was not measured"
[ "$(sed 1d csv | cut -d, -f3 | sort -u)" = 3 ] || fail "the wave number is not the one asked for"
"$perrin" show other measured/pair_distribution > out 2>&1 && fail "measured what was not named"

says 'needs velocities or collisions' "$perrin" analyse run pressure
says "unknown observable 'overlapp'" "$perrin" analyse run overlapp
says 'below 2 pi/L' "$perrin" analyse run 'self_scattering: {wave_numbers: [0.01]}'
rm run/trajectory/replica-0001.h5
says "there is no file 'run/trajectory/replica-0001.h5'" "$perrin" analyse run
sed '/^output/d' run.yaml > none.yaml
"$perrin" run none.yaml --quiet --threads 1 || exit 1
says 'nothing to analyse' "$perrin" analyse none

[ $failed -eq 0 ] && echo "analyse: as it should be"
exit $failed
