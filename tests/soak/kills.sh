#!/usr/bin/env bash
# the daemon, killed two hundred times while it edits
set -euo pipefail
POSED_KILLS=200 exec "$(dirname "$0")/../../build/dev/bin/integration_test" --gtest_filter='Kill.WhatWasAcknowledged*'
