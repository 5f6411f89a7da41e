#!/usr/bin/env bash
# The same jobs by strutt and by its peers, in one run, on this machine. Needs python3 and the network once (for the packages); never run by tests.
#   bench/peers/run.sh [--pairs 5] [--max-n 10] [--limit 120] [--only frame|sweep]
# STRUTT_PEERS_VENV names a virtual environment that exists already.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
venv=${STRUTT_PEERS_VENV:-$root/target/peers-venv}
[ -x "$venv/bin/python" ] || python3 -m venv "$venv"
"$venv/bin/python" -m pip install --quiet --disable-pip-version-check -r "$here/requirements.txt"
cargo build --release --quiet --manifest-path "$root/Cargo.toml" -p strutt
cargo build --release --quiet --manifest-path "$root/Cargo.toml" -p strutt-algebra --example frame
# linear algebra of the peers on one core, as ours
export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 MKL_NUM_THREADS=1
exec "$venv/bin/python" "$here/compare.py" --strutt "$root/target/release/strutt" --root "$root" --frame "$root/target/release/examples/frame" "$@"
