#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright 2026 the Yoke authors
"""Makes the pictures of the tutorial, docs/pictures/tutorial/, from runs of its steps: ./dev docs --pictures."""
import json
import math
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import moving

ROOT = Path(__file__).resolve().parents[2]
TARGET = ROOT / "docs/pictures/tutorial"

# Of the mechanism (tests/tutorial/): where the pin is in the crank, how much room it has in the slot.
PIN_IN_CRANK, CLEARANCE = (0.0, 0.05), 2e-4
BACK = (0.60, 0.78)  # [s] the middle of the return, where the force changes sides


def motion(folder):
    return json.loads((folder / "replay.json").read_text())


def lens(folder, begin, end, seconds=9.0, frames=700):
    """The pin in its slot, its way across magnified, as an animation. Slot and pin seen along the slot."""
    run = moving.Run(motion(folder))
    names = [b["name"] for b in run.drawing["bodies"]]
    crank, lever = names.index("crank"), names.index("lever")
    forces = run.values("slot.normal_force")

    def across(t):
        x, y = run.at(crank, *PIN_IN_CRANK, t)
        angle = run.pose(lever, t)[2]
        return math.cos(angle) * x + math.sin(angle) * y

    width, height, middle, radius, gap = 560.0, 250.0, 125.0, 46.0, 34.0
    times = [begin + (end - begin) * i / (frames - 1) for i in range(frames)]
    ys = [middle + gap / CLEARANCE * across(t) for t in times]
    most = max(forces)
    near = [(t, f) for t, f in zip(run.t, forces) if begin - 1e-3 < t < end + 1e-3]
    hot = []
    for i, t in enumerate(times):
        half = 0.5 * (end - begin) / (frames - 1)
        hot.append(max((f for s, f in near if abs(s - t) <= half), default=0.0) / most)
    common = f'dur="{seconds:g}s" repeatCount="indefinite"'
    y_values = ";".join(f"{y:.1f}" for y in ys)
    hot_values = ";".join(f"{min(1.0, math.sqrt(max(h, 0.0))):.2f}" for h in hot)
    walls = ""
    for sign in (-1, 1):
        y = middle + sign * (radius + gap)
        ends = [(0.0, y), (width, y)] if sign > 0 else [(width, y), (0.0, y)]
        path = "M" + "L".join(f"{a:.0f} {b:.0f}" for a, b in ends)
        walls += (f'<rect x="0" y="{y if sign > 0 else 0:.0f}" width="{width:.0f}" height="{height - y if sign > 0 else y:.0f}" '
                  f'fill="{moving.pale(moving.COLORS[0])}"/><path d="{path}" stroke="{moving.COLORS[0]}" stroke-width="2"/>')
    text = 'font-family="sans-serif" font-size="13" fill="#2b3440"'
    clock = (f'<path d="M20 {height - 14}H{width - 20}" stroke="{moving.SOFT}" stroke-width="2"/>'
             f'<circle cy="{height - 14}" r="5" fill="{moving.INK}"><animate attributeName="cx" values="20;{width - 20}" {common}/></circle>'
             f'<text x="20" y="{height - 24}" {text}>{1e3 * begin:.0f} ms</text>'
             f'<text x="{width - 20}" y="{height - 24}" text-anchor="end" {text}>{1e3 * end:.0f} ms</text>')
    pin = moving.COLORS[1]
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:g} {height:g}">'
            f'<rect width="100%" height="100%" fill="#ffffff"/>{walls}'
            f'<circle cx="{width / 2}" cy="{ys[0]:.1f}" r="{radius}" fill="{moving.pale(pin)}" stroke="{pin}" stroke-width="2">'
            f'<animate attributeName="cy" values="{y_values}" {common}/></circle>'
            f'<circle cx="{width / 2}" cy="{ys[0]:.1f}" r="{radius}" fill="#d02030" opacity="0">'
            f'<animate attributeName="cy" values="{y_values}" {common}/>'
            f'<animate attributeName="opacity" values="{hot_values}" {common}/></circle>'
            f'<text x="16" y="24" {text}>lever</text>{clock}</svg>\n')


def chart(series, label, unit):
    """Lines over time, each (name, times, values)."""
    width, height, left, right, top, bottom = 640.0, 260.0, 58.0, 92.0, 30.0, 40.0
    t_end = max(max(t) for _, t, _ in series)
    low, high = min(min(v) for _, _, v in series), max(max(v) for _, _, v in series)
    step = next(k * 10.0 ** e for e in range(-3, 6) for k in (1, 2, 5) if (high - low) / (k * 10.0 ** e) <= 6)
    low, high = step * math.floor(low / step), step * math.ceil(high / step)

    def at(t, v):
        return (left + (width - left - right) * t / t_end, top + (height - top - bottom) * (high - v) / (high - low))

    text = 'font-family="sans-serif" font-size="12" fill="#2b3440"'
    out = [f'<text x="{left}" y="18" {text}>{label} [{unit}]</text>']
    for i in range(round((high - low) / step) + 1):
        v = low + i * step
        _, y = at(0.0, v)
        out.append(f'<path d="M{left} {y:.1f}H{width - right}" stroke="#e2e6ea"/>'
                   f'<text x="{left - 6}" y="{y + 4:.1f}" text-anchor="end" {text}>{v:g}</text>')
    for i in range(int(t_end / 0.5) + 1):
        x, y = at(0.5 * i, low)
        out.append(f'<path d="M{x:.1f} {y:.1f}v4" stroke="{moving.INK}"/>'
                   f'<text x="{x:.1f}" y="{y + 18:.1f}" text-anchor="middle" {text}>{0.5 * i:g}</text>')
    x, y = at(t_end, low)
    out.append(f'<path d="M{left} {y:.1f}H{x:.1f}" stroke="{moving.INK}"/>'
               f'<text x="{x + 8:.1f}" y="{y + 18:.1f}" {text}>time [s]</text>')
    for i, (name, t, v) in enumerate(series):
        color = moving.COLORS[i]
        path = "M" + "L".join("{:.1f} {:.1f}".format(*at(a, b)) for a, b in zip(t, v))
        x, y = at(t[-1], v[-1])
        out.append(f'<path d="{path}" fill="none" stroke="{color}" stroke-width="1.8" stroke-linejoin="round"/>'
                   f'<text x="{x + 8:.1f}" y="{y + 4:.1f}" font-family="sans-serif" font-size="12" fill="{color}">{name}</text>')
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:g} {height:g}">'
            f'<rect width="100%" height="100%" fill="#ffffff"/>' + "".join(out) + "</svg>\n")


def column(folder, name, scale=1.0, every=12):
    run = moving.Run(motion(folder))
    values = [scale * v for v in run.values(name)]
    return run.t[::every] + run.t[-1:], values[::every] + values[-1:]


def main(program):
    TARGET.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as work:
        out = Path(work)
        subprocess.run([program, str(out)], check=True, stdout=subprocess.DEVNULL)
        (TARGET / "ideal.svg").write_text(moving.animation(motion(out / "ideal"), 1.25, 2.25))
        (TARGET / "clearance_lens.svg").write_text(lens(out / "clearance/steel", *BACK))
        (TARGET / "own_law_lens.svg").write_text(lens(out / "own_law/lined", *BACK))
        (TARGET / "ideal_angle.svg").write_text(
            chart([("lever", *column(out / "ideal", "lever.angle", 180.0 / math.pi))], "angle of the lever", "deg"))
        (TARGET / "friction_dissipated.svg").write_text(
            chart([(law, *column(out / "friction" / law, "dissipated")) for law in ("steel", "oiled")],
                  "energy dissipated", "J"))
        for step, plot in (("clearance", "contact_force"), ("own_law", "contact_force"), ("own_law", "hysteresis")):
            shutil.copy(out / step / f"plots/{plot}.png", TARGET / f"{step}_{plot}.png")


if __name__ == "__main__":
    main(sys.argv[1])
