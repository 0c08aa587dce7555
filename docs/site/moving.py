# SPDX-License-Identifier: BSD-3-Clause
# Copyright 2026 the Yoke authors
"""Pictures of a mechanism from what a run stores (replay.json, or the page of `yoke view`).

A body is rigid, so an animation is a picture of each body and a list of its poses: SVG does the rest.
The pictures need no script and no browser to be made, and stay small.
"""
import base64
import json
import math
import re
import struct

COLORS = ["#2f6db5", "#c9742b", "#3d8f5f", "#8a5fb0", "#b8475a", "#5b7f95", "#9a8a2c", "#4f9aa8"]
INK, SOFT, STEEL, PAPER = "#2b3440", "#8a95a3", "#7d8794", "#ffffff"
WIDTH, HEIGHT, MARGIN = 640.0, 400.0, 46.0


def color_of(body):
    return STEEL if body == 0 else COLORS[(body - 1) % len(COLORS)]


def pale(color):
    return "#" + "".join(f"{round(0.3 * int(color[i:i + 2], 16) + 0.7 * 255):02x}" for i in (1, 3, 5))


def replay_of_page(path):
    """The first run in a page written by `yoke view` or `yoke report`."""
    found = re.search(r'<script[^>]*class="run"[^>]*>(.*?)</script>', path.read_text(), re.S)
    return json.loads(found.group(1))


class Run:
    def __init__(self, replay):
        self.drawing = replay["drawing"]
        self.rows = replay["rows"]
        self.columns = {c["name"]: c for c in replay["columns"]}
        self.t = self.values("t") if "t" in self.columns else [0.0]
        names = [b["name"] for b in self.drawing["bodies"]]
        self.poses = [None] + [[self.values(f"{n}.{q}") for q in ("x", "y", "angle")] for n in names[1:]]

    def values(self, name):
        c = self.columns[name]
        for key, code, size in (("f8", "d", 8), ("f4", "f", 4)):
            if key in c:
                raw = base64.b64decode(c[key])
                return list(struct.unpack(f"<{len(raw) // size}{code}", raw))
        return [c.get("constant") or 0.0] * self.rows

    def pose(self, body, t):
        if body == 0:
            return 0.0, 0.0, 0.0
        low, high = 0, len(self.t) - 1
        while low < high:
            middle = (low + high + 1) // 2
            if self.t[middle] <= t:
                low = middle
            else:
                high = middle - 1
        if low + 1 >= len(self.t):
            return tuple(q[low] for q in self.poses[body])
        h = self.t[low + 1] - self.t[low]
        s = min(max((t - self.t[low]) / h, 0.0), 1.0) if h > 0 else 0.0
        return tuple(q[low] + s * (q[low + 1] - q[low]) for q in self.poses[body])

    def at(self, body, x, y, t):
        px, py, a = self.pose(body, t)
        return px + math.cos(a) * x - math.sin(a) * y, py + math.sin(a) * x + math.cos(a) * y


def pairs(flat):
    return [(flat[i], flat[i + 1]) for i in range(0, len(flat) - 1, 2)]


class Picture:
    """Positions in the picture are pixels, y down; a body's own picture is in pixels about its frame."""

    def __init__(self, replay, begin=None, end=None, frames=1, seconds=4.0):
        self.run = Run(replay)
        first, last = self.run.t[0], self.run.t[-1]
        self.begin = first if begin is None else begin
        self.end = last if end is None else end
        self.frames = frames if self.end > self.begin else 1
        self.seconds = seconds
        self.times = [self.begin + (self.end - self.begin) * i / max(self.frames - 1, 1)
                      for i in range(self.frames)]
        self.fit()

    def fit(self):
        box = [math.inf, math.inf, -math.inf, -math.inf]

        def grow(body, x, y, r=0.0):
            for t in (self.times[::4] + self.times[-1:] if body else self.times[:1]):
                px, py = self.run.at(body, x, y, t)
                box[0], box[1] = min(box[0], px - r), min(box[1], py - r)
                box[2], box[3] = max(box[2], px + r), max(box[3], py + r)

        for i, body in enumerate(self.run.drawing["bodies"]):
            if i == 0:
                continue
            grow(i, 0.0, 0.0)
            for x, y in pairs(body["outline"]):
                grow(i, x, y)
        for s in self.run.drawing["shapes"]:
            p = s["points"]
            if s["kind"] == "line" or (s["kind"] == "arrow"):
                continue
            if s["kind"] in ("wall", "curve"):
                for x, y in pairs(p):
                    grow(s["body"], x, y)
            elif p:
                grow(s["body"], p[0], p[1], s.get("radius") or 0.0)
        width, height = max(box[2] - box[0], 1e-9), max(box[3] - box[1], 1e-9)
        self.scale = min((WIDTH - 2 * MARGIN) / width, (HEIGHT - 2 * MARGIN) / height)
        self.x0 = WIDTH / 2 - self.scale * (box[0] + box[2]) / 2
        self.y0 = HEIGHT / 2 + self.scale * (box[1] + box[3]) / 2

    def screen(self, x, y):
        return self.x0 + self.scale * x, self.y0 - self.scale * y

    def own(self, x, y):
        return self.scale * x, -self.scale * y

    # Pieces of SVG.

    @staticmethod
    def number(x):
        return f"{x:.1f}".rstrip("0").rstrip(".") if abs(x) >= 0.05 else "0"

    def path(self, points, closed, style):
        d = "M" + "L".join(f"{self.number(x)} {self.number(y)}" for x, y in points) + ("Z" if closed else "")
        return f'<path d="{d}" {style}/>'

    def circle(self, center, r, style):
        return f'<circle cx="{self.number(center[0])}" cy="{self.number(center[1])}" r="{self.number(r)}" {style}/>'

    def hatch(self, points, color, spacing=9.0, length=7.0):
        d, left, drawn = [], spacing / 2, 0
        for (ax, ay), (bx, by) in zip(points, points[1:]):
            size = math.hypot(bx - ax, by - ay)
            if size <= 0:
                continue
            ux, uy = (bx - ax) / size, (by - ay) / size
            while left < size and drawn < 600:
                x, y = ax + ux * left, ay + uy * left
                d.append(f"M{x:.1f} {y:.1f}l{(-uy - 0.6 * ux) * length:.1f} {(ux - 0.6 * uy) * length:.1f}")
                left += spacing
                drawn += 1
            left -= size
        return f'<path d="{"".join(d)}" fill="none" stroke="{color}" stroke-width="1"/>'

    def foot(self, p):
        x, y = p
        return (self.path([(x, y), (x - 9, y + 15), (x + 9, y + 15)], True,
                          f'fill="{PAPER}" stroke="{INK}" stroke-width="1.3"')
                + self.hatch([(x - 14, y + 15), (x + 14, y + 15)], INK, 6, 5)
                + self.path([(x - 14, y + 15), (x + 14, y + 15)], False, f'stroke="{INK}" stroke-width="1.3"'))

    # What a body looks like in its own axes.

    def body(self, i):
        body, color = self.run.drawing["bodies"][i], color_of(i)
        shapes = [s for s in self.run.drawing["shapes"] if s["body"] == i]
        points = [self.own(x, y) for x, y in pairs(body["outline"])]
        out = []
        if len(points) == 1:
            out.append(self.circle(points[0], 8, f'fill="{pale(color)}" stroke="{color}" stroke-width="1.5"'))
        elif points:
            closed = len(points) > 2
            join = 'stroke-linejoin="round" stroke-linecap="round"'
            if body["given"]:
                out.append(self.path(points, True, f'fill="{pale(color)}" stroke="{color}" stroke-width="1.5" {join}'))
            else:
                fill = pale(color) if closed else "none"
                out.append(self.path(points, closed, f'fill="{color if closed else "none"}" stroke="{color}" stroke-width="14" {join}'))
                out.append(self.path(points, closed, f'fill="{fill}" stroke="{pale(color)}" stroke-width="12" {join}'))
        elif not any(s["kind"] in ("disc", "gear", "wall") for s in shapes):
            r = max(7.0, min(body["gyration"] * self.scale, 60.0))
            out.append(self.circle((0, 0), r, f'fill="{pale(color)}" stroke="{color}" stroke-width="1.5"'))
        out += [self.wall(s, self.own) for s in shapes if s["kind"] == "wall"]
        return "".join(out)

    def wall(self, s, to):
        points = [to(x, y) for x, y in pairs(s["points"])]
        closed, color = s.get("closed", False), color_of(s["body"])
        area = sum(ax * by - bx * ay for (ax, ay), (bx, by) in zip(points, points[1:] + points[:1]))
        material_inside = closed and area > 0
        fill = "none" if not closed else pale(color) if material_inside else PAPER
        out = self.path(points, closed, f'fill="{fill}" stroke="{color}" stroke-width="1.8" stroke-linejoin="round"')
        if not material_inside and s["body"] == 0:
            out += self.hatch(points + (points[:1] if closed else []), color, 9, 6)
        return out

    def line(self, s, to):
        (px, py), (dx, dy) = pairs(s["points"])[:2]
        x, y = to(px, py)
        wall = s["role"] == "contact"
        # Along the picture; a frame that moves needs no more than its diagonal.
        half = WIDTH + HEIGHT
        u = (dx, -dy)
        ends = [(x - half * u[0], y - half * u[1]), (x + half * u[0], y + half * u[1])]
        color = INK if s["body"] == 0 else color_of(s["body"])
        style = (f'stroke="{color}" stroke-width="1.6"' if wall else
                 f'stroke="{SOFT}" stroke-width="1" stroke-dasharray="10 4 2 4"')
        return self.path(ends, False, style) + (self.hatch(ends, SOFT, 9, 7) if wall else "")

    def on_top(self, s):
        """Symbols that belong to one body, in its axes."""
        kind, p, i = s["kind"], s["points"], s["body"]
        to = self.own if i else self.screen
        at, color = to(p[0], p[1]), color_of(i)
        if kind == "pin":
            foot = self.foot(at) if i == 0 else ""
            return foot + self.circle(at, 4.5, f'fill="{PAPER}" stroke="{INK}" stroke-width="1.6"')
        if kind == "weld":
            return f'<rect x="{at[0] - 5:.1f}" y="{at[1] - 5:.1f}" width="10" height="10" fill="{INK}"/>'
        if kind == "point":
            return self.circle(at, 4, f'fill="{PAPER}" stroke="{INK}" stroke-width="1.5"')
        if kind == "block":
            a, b, ux, uy = 13.0, 8.0, p[2], -p[3]
            corners = [(at[0] + k * a * ux - m * b * uy, at[1] + k * a * uy + m * b * ux)
                       for k, m in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
            return self.path(corners, True, f'fill="{PAPER}" stroke="{INK if i == 0 else color}" stroke-width="1.6"')
        if kind == "disc":
            r = (s.get("radius") or 0.0) * self.scale
            if r < 2:
                return self.circle(at, 2.5, f'fill="{color}"')
            return (self.circle(at, r, f'fill="{pale(color)}" stroke="{color}" stroke-width="1.4"')
                    + self.path([at, (at[0] + r, at[1])], False, f'stroke="{color}" stroke-width="1"'))
        if kind == "gear":
            r = s["radius"] * self.scale
            return (self.circle(at, r, f'fill="none" stroke="{color}" stroke-width="1.5" stroke-dasharray="6 3"')
                    + self.path([at, (at[0] + r, at[1])], False, f'stroke="{color}" stroke-width="1.4"'))
        if kind == "curve":
            return self.path([to(x, y) for x, y in pairs(p)], s.get("closed", False),
                             f'fill="none" stroke="{INK}" stroke-width="1.4" stroke-dasharray="7 3"')
        return ""

    # Motion.

    def moving(self, i, inside):
        """The picture of a body where it is, at all times."""
        if not inside:
            return ""
        poses = [self.run.pose(i, t) for t in self.times]
        places = [self.screen(x, y) for x, y, _ in poses]
        turns = [-math.degrees(a) for _, _, a in poses]
        start = f'translate({places[0][0]:.1f} {places[0][1]:.1f}) rotate({turns[0]:.1f})'
        if self.frames == 1:
            return f'<g transform="{start}">{inside}</g>'
        moves = ";".join(f"{x:.1f} {y:.1f}" for x, y in places)
        spins = ";".join(f"{a:.1f}" for a in turns)
        common = f'dur="{self.seconds:g}s" repeatCount="indefinite"'
        return (f'<g><animateTransform attributeName="transform" type="translate" values="{moves}" {common}/>'
                f'<g><animateTransform attributeName="transform" type="rotate" values="{spins}" {common}/>'
                f"{inside}</g></g>")

    def between(self, s):
        """Springs and rods between two bodies."""
        def shape(t):
            a = self.screen(*self.run.at(s["body"], s["points"][0], s["points"][1], t))
            b = self.screen(*self.run.at(s["other"], s["points"][2], s["points"][3], t))
            if s["kind"] == "rod":
                return [a, b]
            size = math.hypot(b[0] - a[0], b[1] - a[1]) or 1.0
            ux, uy = (b[0] - a[0]) / size, (b[1] - a[1]) / size
            points, coils = [a], 8
            for i in range(2 * coils + 1):
                k = size * (0.12 + 0.76 * i / (2 * coils))
                w = 0 if i in (0, 2 * coils) else 7 if i % 2 else -7
                points.append((a[0] + k * ux - w * uy, a[1] + k * uy + w * ux))
            return points + [b]

        def text(points):
            return "M" + "L".join(f"{x:.0f} {y:.0f}" for x, y in points)

        style = f'fill="none" stroke="{INK if s["kind"] == "rod" else "#3d8f5f"}" stroke-width="{3 if s["kind"] == "rod" else 1.6}"'
        ends = [self.screen(*s["points"][k:k + 2]) for body, k in ((s["body"], 0), (s["other"], 2)) if body == 0]
        feet = "".join(self.foot(p) + self.circle(p, 3.5, f'fill="{PAPER}" stroke="{INK}" stroke-width="1.4"') for p in ends)
        if self.frames == 1:
            return f'{feet}<path d="{text(shape(self.times[0]))}" {style}/>'
        values = ";".join(text(shape(t)) for t in self.times)
        return (f'{feet}<path {style}><animate attributeName="d" values="{values}" dur="{self.seconds:g}s" '
                f'repeatCount="indefinite"/></path>')

    def svg(self):
        shapes, bodies = self.run.drawing["shapes"], self.run.drawing["bodies"]
        out = []
        for s in shapes:
            if s["kind"] == "line" and s["body"] == 0:
                out.append(self.line(s, self.screen))
            elif s["kind"] == "wall" and s["body"] == 0:
                out.append(self.wall(s, self.screen))

        def size(i):
            points = pairs(bodies[i]["outline"])
            if not points:
                return 0.0
            xs, ys = [p[0] for p in points], [p[1] for p in points]
            return float(f"{math.hypot(max(xs) - min(xs), max(ys) - min(ys)):.3g}")

        carries = {s["body"] for s in shapes if s["kind"] == "wall"}
        order = sorted(range(1, len(bodies)), key=lambda i: (i not in carries, -size(i)))
        for i in order:
            lines = [s for s in shapes if s["kind"] == "line" and s["body"] == i]
            walls = "".join(self.line(s, self.own) for s in lines if s["role"] == "contact")
            guides = "".join(self.line(s, self.own) for s in lines if s["role"] != "contact")
            out.append(self.moving(i, walls + self.body(i) + guides))
        out += [self.between(s) for s in shapes if s["kind"] in ("spring", "rod")]
        for layer in (("curve", "gear", "disc"), ("block", "weld", "pin", "point")):
            for i in range(len(bodies)):
                inside = "".join(self.on_top(s) for s in shapes if s["body"] == i and s["kind"] in layer)
                out.append(self.moving(i, inside) if i else inside)
        return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH:g} {HEIGHT:g}">'
                f'<rect width="100%" height="100%" fill="{PAPER}"/>' + "".join(out) + "</svg>\n")


def still(replay):
    return Picture(replay).svg()


def animation(replay, begin=None, end=None, seconds=4.0, frames=121):
    return Picture(replay, begin, end, frames, seconds).svg()
