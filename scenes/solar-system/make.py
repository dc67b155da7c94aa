#!/usr/bin/env python3
"""Writes solar-system.glb: a black speck of three millimetres at the origin, inside the Earth. This world is its globes. Needs Python
3's own library only; the same bytes come out every time."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "avenue"))
import speck

if __name__ == "__main__":
    speck.write("solar-system", 1e-11)
