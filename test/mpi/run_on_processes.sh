#!/usr/bin/env bash
# The program by mpiexec leaves the files that it leaves alone, stops and goes on, and refuses with one line.
#   run_on_processes.sh PROGRAM MPIEXEC
set -euo pipefail
program=$1 mpiexec=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

fail() { echo "run_on_processes: $*" >&2; cat log >&2; exit 1; }
same() {
  for file in energy.csv final.txt solution.h5 solution.xdmf; do cmp "$1/$file" "$2/$file" || fail "$2/$file differs"; done
}

cat > case.toml <<'CASE'
[problem]
name = "klein_gordon"
points = [40, 36]
length = [6.0, 5.0]
alpha = 1.0
gamma = 0.01
initial = { u = "exp(-(x-1)^2-y^2)", v = "0.1*sin(x+2*y)" }
[method]
name = "seisav"
h = 0.01
CASE

"$program" run case.toml --quiet --set time.end=2 --out alone 2> log || fail "alone"
for processes in 2 3; do
  "$mpiexec" -n $processes "$program" run case.toml --quiet --set time.end=2 --out on_$processes 2> log || fail "on $processes"
  same alone on_$processes
done

# A process that is asked to end lets all of them save; another number of them goes on.
"$mpiexec" -n 3 "$program" run case.toml --set time.end=1e5 --out long 2> log &
running=$!
for _ in $(seq 600); do [[ -s long/energy.csv.partial ]] && break; sleep 0.1; done
sleep 0.5
kill -TERM "$(pgrep -f "$program run case.toml --set time.end=1e5" | tail -1)"
wait $running && fail "exit code 0 of a run that was stopped"
grep -q "interrupted: stopped at t = .*goes on from there" log || fail "no word of the stop"
t=$(sed -n 's/.*"t": \([0-9.]*\),.*/\1/p' long/summary.json | head -1)
end=$(awk "BEGIN { print int($t) + 2 }")
"$mpiexec" -n 2 "$program" resume long --until "$end" --quiet 2> log || fail "the resume"
"$program" run case.toml --quiet --set time.end="$end" --out whole 2> log || fail "whole"
same whole long

# One line of ours, beside what mpiexec says.
"$mpiexec" -n 3 "$program" run case.toml --set method.h=-1 2> log && fail "h = -1 runs"
[[ $(grep -c "^seiche: --set method.h=-1: method.h = -1 must be > 0$" log) == 1 ]] || fail "h = -1"
"$mpiexec" -n 3 "$program" run case.toml --nonsense 2> log && fail "nonsense"
[[ $(grep -c "^seiche: unknown option '--nonsense'" log) == 1 ]] || fail "nonsense"
"$mpiexec" -n 1 "$program" run case.toml : -n 1 "$program" run other.toml 2> log && fail "two commands"
[[ $(grep -c "^seiche: the processes were given different commands" log) == 1 ]] || fail "two commands"
SEICHE_ALONE=1 "$mpiexec" -n 1 "$program" run case.toml --quiet --set time.end=2 --out one : \
  -n 1 "$program" run case.toml --quiet --set time.end=2 --out other 2> log || fail "each alone"
same alone one
same alone other
"$mpiexec" -n 2 "$program" run case.toml --set backend.plan=measure 2> log && fail "measured plans"
[[ $(grep -c "^seiche: plan = \"measure\" is for one process" log) == 1 ]] || fail "measured plans"
"$mpiexec" -n 2 "$program" run case.toml --set problem.points=40 problem.length=2 initial.u=0 2> log && fail "one axis"
[[ $(grep -c "^seiche: " log) == 1 ]] || fail "one axis"
echo "the same files on several processes"
