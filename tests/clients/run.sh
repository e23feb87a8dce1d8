#!/usr/bin/env bash
# run.sh EDGEWISE [words of check names] : exports, and loads the files into the programs they are for.
# Installs these into target/clients first. What may be missing is said at the end; anything else missing is a failure.
set -euo pipefail
edgewise=$(realpath "$1")
shift
cd "$(dirname "$0")"
clients=$(realpath ../..)/target/clients

python3 -m venv "$clients"
"$clients/bin/pip" install --quiet --disable-pip-version-check --requirement requirements.txt
if command -v npm >/dev/null; then
    cp package.json "$clients/"
    npm install --silent --no-audit --no-fund --prefix "$clients" >/dev/null
fi
exec "$clients/bin/python" check.py "$edgewise" "$@"
