#!/usr/bin/env python3
"""Makes `gully.asc`, the ground of `../gully_terrain.yaml`: a made-up gully on a grid of 1 m (python3 make_gully.py).

It falls towards the south-east, with a bed about 4 m wide that winds a little, banks of some 45 degrees, flatter slopes above them, and bumps of
a few centimetres. Heights depend on nothing but the formulas below.
"""

import math
from pathlib import Path

WEST, SOUTH = 2_600_000.0, 1_200_000.0  # lower left corner (m)
COLUMNS, ROWS, CELL = 110, 90, 1.0
BARRIER = (70.0, 40.0)  # about where the barrier stands, from the corner (m)
HEADING = math.radians(120.0)  # downstream, clockwise from north


def height(east, north):
    """Height of the ground (m) at a place counted from the corner."""
    x, y = east - BARRIER[0], north - BARRIER[1]
    along = x * math.sin(HEADING) + y * math.cos(HEADING)
    across = x * math.cos(HEADING) - y * math.sin(HEADING)
    across -= 0.8 * math.sin(along / 9.0)
    # 16 degrees at the barrier, 20 degrees from 25 m upstream on.
    bed = 800.0 - math.tan(math.radians(16.0)) * along
    if along < -25.0:
        bed += (math.tan(math.radians(20.0)) - math.tan(math.radians(16.0))) * (-25.0 - along)
    side = abs(across)
    bank = 0.08 * min(side, 2.0)
    bank += 1.0 * max(0.0, min(side, 7.0) - 2.0)
    bank += 0.45 * max(0.0, side - 7.0)
    bumps = 0.05 * math.sin(1.9 * east + 0.7 * north) + 0.04 * math.sin(0.8 * east - 2.3 * north)
    return bed + bank + bumps


def main():
    lines = [f"ncols {COLUMNS}", f"nrows {ROWS}", f"xllcorner {WEST:.1f}", f"yllcorner {SOUTH:.1f}", f"cellsize {CELL}", "NODATA_value -9999"]
    for row in reversed(range(ROWS)):
        lines.append(" ".join(f"{height(column + 0.5, row + 0.5):.2f}" for column in range(COLUMNS)))
    Path(__file__).with_name("gully.asc").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
