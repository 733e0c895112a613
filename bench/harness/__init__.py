"""The comparison of `scripts/bench`, and what it shares with `scripts/instructions`."""

import pathlib

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
BENCH = ROOT / "bench"
