#!/bin/sh
# A study's numbers for other programs: members and time series of the pump (pump.toml) as CSV, for pandas, R and spreadsheets, and as one MAT file,
# for MATLAB, Octave and scipy.  Writes to the folder it is started in; what stands behind its name goes to `slideway run`.
#   sh export.sh --set study.members=64
set -eu
jobs=$(dirname "$0")
slideway run "$jobs/pump.toml" -o pump.nc --set study.samples=501 "$@"
slideway export pump.nc -o pump_members.csv                 # a row for each member: its inputs, its works and losses
slideway export pump.nc -o pump_series.csv --series y,vy    # a row for each sample of each member
slideway export pump.nc -o pump.mat --series y,vy           # both: members.load_work, series.y, units.series.y
