#!/usr/bin/env bash
# check.sh BIN WORK SOURCE PROFILE DOMAIN: records what publishers of both vendors send on loopback and has node read it back;
# then kills a recorder and reads what it left. Exits 77 where node or npm is missing (ctest: skipped).
set -u
bin=$1 work=$2 source=$3 profile=$4 domain=$5
for tool in node npm; do
  if ! command -v "$tool" > /dev/null; then
    echo "skipped: $tool is not installed, and reading a recording back with independent libraries needs it"
    exit 77
  fi
done

states=1000 tiles=100
pids=()
trap '((${#pids[@]})) && kill -KILL "${pids[@]}" 2> /dev/null' EXIT
fail() { echo "FAILED: $*"; exit 1; }
export CYCLONEDDS_URI="file://$profile"

mkdir -p "$work" && cp "$source"/*.mjs "$source"/package.json "$source"/package-lock.json "$work" && cd "$work" || exit 1
rm -f ./*.mcap
stamp=node_modules/.swallowtail-lock
if ! cmp -s package-lock.json "$stamp"; then
  npm ci --ignore-scripts --prefer-offline --no-audit --no-fund --loglevel=error || fail "npm ci"
  cp package-lock.json "$stamp"
fi

publish() {  # VENDOR BASE
  timeout 60 "$bin/tests/record_publish_$1" "$domain" "$2" $states $tiles &
  pids+=($!)
}
record() {  # FILE; returns once the recorder has its readers
  rm -f ready
  mkfifo ready || fail "mkfifo"
  "$bin/bin/swallowtail-record" -o "$1" --domain "$domain" --json > "$1.json" 2> ready &
  recorder=$!
  pids+=("$recorder")
  exec 3< ready
  read -r -t 20 line <&3 || fail "the recorder does not start"
  cat <&3 >&2 &
  exec 3<&-
}

record both.mcap
publish fast 100; fast=$!
publish cyclone 200; cyclone=$!
wait "$fast" || fail "the Fast DDS publisher"
wait "$cyclone" || fail "the Cyclone DDS publisher"
kill -INT "$recorder"
wait "$recorder" || fail "the recorder's exit code is $?"
cat both.mcap.json
node check_values.mjs both.mcap $states $tiles fast=100 cyclone=200 || fail "values read back differ"
"$bin/tests/record_check_recording" both.mcap $states $tiles 100 200 || fail "the project's own reader gives other values"

record killed.mcap
publish cyclone 200; cyclone=$!
wait "$cyclone" || fail "the Cyclone DDS publisher"
kill -KILL "$recorder"
wait "$recorder" 2> /dev/null
# The publisher sends at 500 Hz and then is heard out: at most the last half second of its 2 s may be gone.
node check_killed.mjs killed.mcap $((states * 3 / 4 - 25)) || fail "a killed recorder's file"
echo "all read back"
