#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# readers.sh PROGRAM SAME: h5py opens what was written, and MDAnalysis the trajectory. Skipped
# where these Python packages are missing (python3-h5py, python3-mdanalysis).
PROGRAM=$1 SAME=$2
. "$(dirname "$0")/common.sh"
python=
for candidate in /usr/bin/python3 python3; do
    $candidate -W ignore -c 'import h5py' 2>/dev/null && python=$candidate && break
done
[ -n "$python" ] || skip "python3-h5py is not installed"
start "$work/run" >"$work/out" 2>&1 || fail "the run: $(cat "$work/out")"

$python -W ignore - "$work/run" 2>"$work/err" <<'END' || fail "h5py: $(cat "$work/err")"
import sys, h5py, numpy
run = sys.argv[1]
with h5py.File(run + "/results.h5", "r") as results:
    assert results.attrs["format_version"] == 1
    assert len(results["stages"]) > 0 and "health" in results["perrin"]
    series = scalars = 0
    for stage in results["stages"].values():
        for name, group in stage.items():
            if name == "quantities":
                for quantity in group.values():
                    values = quantity[:]
                    assert numpy.isclose(quantity.attrs["value"], numpy.nanmean(values), equal_nan=True)
                    assert isinstance(quantity.attrs["unit"], str)
                    scalars += 1
                continue
            shape = tuple(group[axis].shape[0] for axis in group.attrs["axes"])
            assert group["mean"].shape == shape and group["error"].shape == shape
            assert group["replicas"].shape == (results.attrs["replicas"],) + shape
            series += 1
with h5py.File(run + "/trajectory/replica-0000.h5", "r") as file:
    assert list(file["h5md"].attrs["version"]) == [1, 1]
    position = file["particles/trajectory/position/value"]
    assert position.shape[2] == 3 and (file["perrin/crc32c"][:] != 0).all()
    assert [len(file["perrin/species_" + what]) for what in ("names", "shapes", "lengths")] == [2, 2, 2]
    if b"spherocylinder" in file["perrin/species_shapes"][:]:
        orientation = file["particles/trajectory/orientation"]
        assert orientation["value"].shape == position.shape
        assert numpy.allclose((orientation["value"][:] ** 2).sum(axis=2), 1, atol=1e-12)
        assert orientation["step"] == file["particles/trajectory/position/step"]
        print("with body axes")
    else:
        assert "orientation" not in file["particles/trajectory"]
    assert numpy.isfinite(position[:]).all() and (numpy.diff(file["particles/trajectory/position/time"]) > 0).all()
print(series, "series and", scalars, "quantities read by h5py")
END

$python -W ignore -c 'import MDAnalysis' 2>/dev/null || skip "python3-mdanalysis is not installed"
$python -W ignore - "$work/run" 2>"$work/err" <<'END' || fail "MDAnalysis: $(cat "$work/err")"
import sys, h5py, numpy, MDAnalysis
path = sys.argv[1] + "/trajectory/replica-0001.h5"
with h5py.File(path, "r") as file:
    positions = file["particles/trajectory/position/value"][:]
    edges = file["particles/trajectory/box/edges/value"][:]
    times = file["particles/trajectory/position/time"][:]
universe = MDAnalysis.Universe.empty(positions.shape[1], trajectory=False)
universe.load_new(path, format="H5MD", convert_units=False)
assert len(universe.trajectory) == len(positions)
for frame in universe.trajectory:
    assert numpy.allclose(universe.atoms.positions, positions[frame.frame], atol=1e-5)
    assert numpy.allclose(frame.dimensions[:3], edges[frame.frame].diagonal(), rtol=1e-6)
    assert numpy.allclose(frame.dimensions[3:], 90) and frame.time == times[frame.frame]
print(len(universe.trajectory), "frames read by MDAnalysis", MDAnalysis.__version__)
END
finish "readers"
