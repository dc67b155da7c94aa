#!/usr/bin/env python3
"""Writes voyage.glb: a black speck of a millionth of a light-year at the origin. The voyage's world is its stars. Needs Python 3's own
library only; the same bytes come out every time."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "avenue"))
import speck

if __name__ == "__main__":
    speck.write("voyage", 1e-6)
