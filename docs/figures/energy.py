"""Draws the energy history of a run as SVG, from its print log.

    python3 docs/figures/energy.py out/can_crush.o "TITLE" > docs/figures/can_crush_energy.svg
"""

import math
import sys

WIDTH, HEIGHT = 720, 400
LEFT, RIGHT, TOP, BOTTOM = 80, 150, 50, 50
# Column of the step log, colour, name.
CURVES = [(2, "#1f5fbf", "kinetic"), (8, "#d1662b", "internal"), (9, "#3a8f4d", "hourglass")]
LOSS = (13, "#8a3fa0", "taken by contact")


def steps(path):
    """The lines of the step log as numbers."""
    rows = []
    for line in open(path):
        words = line.split()
        if len(words) >= 16 and words[0].isdigit():
            rows.append([float(word) for word in words])
    if not rows:
        sys.exit(f"{path} has no step log")
    return rows


def tick(largest):
    """The largest of 1, 2, 5, 10, 20 ... that fits into a value at least four times."""
    decade = 10.0 ** math.floor(math.log10(largest / 4))
    return max(decade * part for part in (1, 2, 5) if decade * part * 4 <= largest)


def draw(rows, title):
    """The picture, a text."""
    times = [row[1] for row in rows]
    curves = [([row[at] for row in rows], colour, name) for at, colour, name in CURVES]
    curves.append(([-row[LOSS[0]] for row in rows], LOSS[1], LOSS[2]))
    total = [sum(values[i] for values, _, _ in curves) + row[10] + row[11] for i, row in enumerate(rows)]
    curves.append((total, "#444444", "sum"))
    unit = tick(max(total))
    top = 1.05 * max(total)
    x = lambda t: LEFT + (WIDTH - LEFT - RIGHT) * t / times[-1]
    y = lambda e: HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * e / top
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" font-size="13">']
    out.append(f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>')
    out.append(f'<text x="{LEFT}" y="28" font-size="16" font-weight="bold">{title}</text>')
    for i in range(int(top / unit) + 1):
        out.append(f'<path d="M{LEFT} {y(i * unit):.1f}H{WIDTH - RIGHT}" stroke="#dddddd"/>')
        out.append(f'<text x="{LEFT - 8}" y="{y(i * unit) + 4:.1f}" text-anchor="end">{i * unit / 1e3:g}</text>')
    milliseconds = 1e3 * times[-1]
    pace = tick(milliseconds)
    for i in range(int(milliseconds / pace * 1.0001) + 1):
        at = x(i * pace / 1e3)
        out.append(f'<text x="{at:.1f}" y="{HEIGHT - BOTTOM + 20}" text-anchor="middle">{i * pace:g}</text>')
    out.append(f'<text x="{(LEFT + WIDTH - RIGHT) / 2}" y="{HEIGHT - 8}" text-anchor="middle">time, ms</text>')
    out.append(f'<text x="{LEFT}" y="{TOP - 6}" text-anchor="middle">1000 in·lb</text>')
    ends = sorted((y(values[-1]), colour, name) for values, colour, name in curves)
    last = -1e9
    for values, colour, _ in curves:
        points = " ".join(f"{x(t):.1f},{y(e):.1f}" for t, e in zip(times, values))
        out.append(f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="2"/>')
    for at, colour, name in ends:
        last = max(at, last + 15)
        out.append(f'<text x="{WIDTH - RIGHT + 8}" y="{last + 4:.1f}" fill="{colour}">{name}</text>')
    out.append("</svg>")
    return "\n".join(out)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    print(draw(steps(sys.argv[1]), sys.argv[2]))
