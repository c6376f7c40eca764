#!/usr/bin/env bash
# launcher_test.sh KILN FAKE_WORLD: runs `kiln demo` with stand-ins and looks at what it leaves behind.
set -u
kiln=$1 fake_world=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0
fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}
expect_status() { [ "$1" -eq "$2" ] || fail "$3: exit status $2, expected $1"; }
contains() { grep -qF -- "$2" "$1" || { fail "$3: no '$2' in:"; cat "$1"; }; }
# shellcheck disable=SC2317
ended() { ! kill -0 "$1" 2>/dev/null; }
# until SECONDS COMMAND...: polls with a limit that only a hang reaches
until_true() {
  local limit=$((SECONDS + $1))
  shift
  until "$@"; do
    ((SECONDS < limit)) || return 1
    read -r -t 0.05 <> <(:) # waits: nobody writes
  done
  return 0
}

programs=$work/bin
mkdir "$programs"
ln -s "$fake_world" "$programs/kiln-sim"
# The robot ends when the station has taken its picture; how, the test says in FAKE_OUTCOME.
cat >"$programs/kiln-robotd" <<'ROBOT'
#!/usr/bin/env bash
[ "$1" = --list-missions ] && { printf 'fire\tfire\tfinds the fire\n'; exit 0; }
echo "$*" >"$FAKE_NOTES/robotd"
[ "$FAKE_OUTCOME" = refuses ] && { echo "kiln-robotd: port 7300 is in use" >&2; exit 2; }
while [ $# -gt 0 ]; do [ "$1" = --report ] && report=$2; shift; done
until [ -f "$FAKE_NOTES/station" ] && [ "$FAKE_OUTCOME" != hangs ]; do read -r -t 0.05 <> <(:); done
echo "{\"outcome\": \"$FAKE_OUTCOME\"}" >"$report"
[ "$FAKE_OUTCOME" = success ]
ROBOT
cat >"$programs/kiln-station" <<'STATION'
#!/usr/bin/env bash
while [ $# -gt 0 ]; do [ "$1" = --screenshot ] && pictures=$2; shift; done
echo "picture on $DISPLAY" >"$pictures/01-EnterBuilding.png"
echo "$DISPLAY" >"$FAKE_NOTES/station"
STATION
chmod +x "$programs"/kiln-{robotd,station}
export KILN_PROGRAMS=$programs FAKE_NOTES=$work/notes KILN_LISTEN=ipc://$work/robot
unset DISPLAY WAYLAND_DISPLAY

demo() { # demo OUTCOME ARGUMENTS...
  export FAKE_OUTCOME=$1
  shift
  rm -rf "$FAKE_NOTES"
  mkdir "$FAKE_NOTES"
  "$kiln" demo "$@" >"$work/output" 2>&1
}
world_process() { sed -n 's/.*process //p' "$1/sim.log"; }

demo success --seed 3 --out "$work/good"
expect_status 0 $? "a successful mission"
contains "$work/output" "01-EnterBuilding.png" "a screenshot is announced"
contains "$work/output" "report: $work/good/report.json" "the report is named"
contains "$work/notes/robotd" "--mission fire --start --report $work/good/report.json" "the daemon's options"
[ -s "$work/notes/station" ] || fail "the station had no display"
until_true 10 ended "$(world_process "$work/good")" || fail "the world outlived the demo"

demo success --record --out "$work/recorded"
expect_status 0 $? "a recorded mission"
contains "$work/notes/robotd" "--record $work/recorded/recordings" "the daemon is told to record"

demo failure --out "$work/bad"
expect_status 1 $? "a mission that failed"
contains "$work/output" "did not succeed" "a failed mission is called one"

demo refuses --out "$work/refused"
expect_status 2 $? "a daemon that refuses to start"
contains "$work/output" "port 7300 is in use" "its reason is shown"
until_true 10 ended "$(world_process "$work/refused")" || fail "the world outlived a refused demo"

# A signal ends everything that was started.
export FAKE_OUTCOME=hangs
rm -rf "$FAKE_NOTES" && mkdir "$FAKE_NOTES"
"$kiln" demo --headless --out "$work/killed" >"$work/output" 2>&1 &
launcher=$!
until_true 30 test -s "$work/notes/station" || fail "the demo did not start"
world=$(world_process "$work/killed")
kill -TERM "$launcher"
wait "$launcher"
expect_status 143 $? "a demo ended by SIGTERM"
until_true 10 ended "$world" || fail "the world outlived a killed demo"

# Bad arguments start nothing.
for arguments in "castle" "--seed x" "--seed" "--out" "--sideways" "--world none" "--world" "--blueprint resources/blueprints/lab.txt" "wall --blueprint none.txt" "--bricks 5" "wall --bricks x"; do
  # shellcheck disable=SC2086
  demo success $arguments
  expect_status 1 $? "kiln demo $arguments"
  [ -e "$work/notes/robotd" ] && fail "kiln demo $arguments started a daemon"
done
"$kiln" nonsense >"$work/output" 2>&1
expect_status 1 $? "an unknown command"
contains "$work/output" "no command 'nonsense'" "an unknown command is named"
"$kiln" help >"$work/output"
expect_status 0 $? "help"
"$kiln" demo --help >"$work/output"
expect_status 0 $? "demo --help"

[ "$failures" -eq 0 ] && echo "launcher: all good"
exit "$failures"
