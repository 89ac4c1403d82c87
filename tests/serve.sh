#!/usr/bin/env bash
# Checks the sources of the page of `barrier-check serve`, that the bundle which the program carries was built from them, and the page itself in a
# browser. Needs Node.js, npm, Chromium, and the program in target/release.
set -euo pipefail
cd "$(dirname "$0")/../templates/serve"
npm ci --no-audit --no-fund --loglevel=error
npm run --silent check
committed=$(sha256sum < bundle.js)
npm run --silent build
if [ "$committed" != "$(sha256sum < bundle.js)" ]; then
    echo "error: bundle.js is not what its sources make: run \`npm run build\` in templates/serve and commit it"
    exit 1
fi
if [ ! -x "${CHROMIUM:-/usr/bin/chromium}" ]; then
    echo "skipped: no Chromium here, so the page was not tried"
    exit 0
fi
npm run --silent test
