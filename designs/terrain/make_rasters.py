#!/usr/bin/env python3
"""Makes the grounds of the designs that have a terrain, on grids of 1 m: `gully.asc` and `valley.asc` (python3 make_rasters.py).

Both are made up: a bed that winds a little, banks of some 45 degrees, flatter slopes above them, and bumps of a few centimetres. Heights depend on
nothing but the formulas below.
"""

import math
from pathlib import Path

CELL = 1.0  # m


class Gully:
    """A gully whose barrier stands at a place counted from the lower left corner (m)."""

    def __init__(self, corner, size, barrier, heading, half_bed, reaches):
        self.corner, self.size, self.barrier = corner, size, barrier
        self.heading = math.radians(heading)  # downstream, clockwise from north
        self.half_bed = half_bed
        # Distance upstream of the barrier with the slope that begins there (m, degrees), the nearest first.
        self.reaches = reaches

    def bed(self, along):
        """Height of the lowest line (m) at a level distance downstream of the barrier."""
        height = 800.0 - math.tan(math.radians(self.reaches[0][1])) * along
        for (_, before), (start, slope) in zip(self.reaches, self.reaches[1:]):
            change = math.tan(math.radians(slope)) - math.tan(math.radians(before))
            height += change * max(0.0, -start - along)
        return height

    def height(self, east, north):
        """Height of the ground (m) at a place counted from the corner."""
        x, y = east - self.barrier[0], north - self.barrier[1]
        along = x * math.sin(self.heading) + y * math.cos(self.heading)
        across = x * math.cos(self.heading) - y * math.sin(self.heading)
        side = abs(across - 0.8 * math.sin(along / 9.0))
        bank = 0.08 * min(side, self.half_bed)
        bank += 1.0 * max(0.0, min(side, self.half_bed + 5.0) - self.half_bed)
        bank += 0.45 * max(0.0, side - self.half_bed - 5.0)
        bumps = 0.05 * math.sin(1.9 * east + 0.7 * north) + 0.04 * math.sin(0.8 * east - 2.3 * north)
        return self.bed(along) + bank + bumps

    def write(self, name):
        (columns, rows), (west, south) = self.size, self.corner
        lines = [f"ncols {columns}", f"nrows {rows}", f"xllcorner {west:.1f}", f"yllcorner {south:.1f}", f"cellsize {CELL}", "NODATA_value -9999"]
        for row in reversed(range(rows)):
            lines.append(" ".join(f"{self.height(column + 0.5, row + 0.5):.2f}" for column in range(columns)))
        Path(__file__).with_name(name).write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    Gully((2_600_000.0, 1_200_000.0), (110, 90), (70.0, 40.0), 120.0, 2.0, [(0.0, 16.0), (25.0, 20.0)]).write("gully.asc")
    Gully((2_610_000.0, 1_190_000.0), (60, 170), (30.0, 24.0), 172.0, 2.1, [(0.0, 25.0)]).write("valley.asc")
