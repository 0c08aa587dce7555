// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// Mouse, touch and keyboard on the mechanism.

const speeds = [10, 3, 1, 0.5, 0.2, 0.1, 0.03, 0.01, 1e-3, 1e-4, 1e-5, 1e-6];
const speedText = (s) => (s >= 1 ? `\u00d7 ${s}` : `1/${Math.round(1 / s)}`);

function listenToCanvas(app) {
  const canvas = $("mechanism"), camera = app.camera;
  const pointers = new Map();
  const at = (e) => { const r = canvas.getBoundingClientRect(); return [e.clientX - r.left, e.clientY - r.top]; };
  canvas.addEventListener("pointerdown", (e) => { canvas.setPointerCapture(e.pointerId); pointers.set(e.pointerId, at(e)); });
  canvas.addEventListener("pointermove", (e) => {
    if (!pointers.has(e.pointerId)) return;
    const before = pointers.get(e.pointerId), now = at(e);
    if (pointers.size === 1) camera.pan(now[0] - before[0], before[1] - now[1] ? now[1] - before[1] : 0);
    if (pointers.size === 2) {  // two fingers zoom about the one that rests
      const other = [...pointers].find(([id]) => id !== e.pointerId)[1];
      const distance = (p) => Math.hypot(p[0] - other[0], p[1] - other[1]) || 1;
      camera.zoom(distance(now) / distance(before), other);
    }
    pointers.set(e.pointerId, now);
    app.redraw();
  });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (e) => pointers.delete(e.pointerId));
  canvas.addEventListener("wheel", (e) => {
    e.preventDefault();
    camera.zoom(Math.exp(-e.deltaY * 0.0015), at(e));
    app.redraw();
  }, {passive: false});
  canvas.addEventListener("dblclick", () => app.fit());
}

function listenToKeys(app) {
  const keys = {
    " ": () => app.toggle(), "n": () => app.step(1), "p": () => app.step(-1),
    "ArrowRight": (e) => app.nudge(e.shiftKey ? 10 : 1), "ArrowLeft": (e) => app.nudge(e.shiftKey ? -10 : -1),
    "Home": () => app.seek(app.run.start), "End": () => app.seek(app.run.end),
    "+": () => app.zoom(1.3), "=": () => app.zoom(1.3), "-": () => app.zoom(1 / 1.3), "0": () => app.fit(),
    "t": () => app.toggleTheme(),
  };
  document.addEventListener("keydown", (e) => {
    if (e.ctrlKey || e.metaKey || e.altKey || !keys[e.key]) return;
    const tag = e.target.tagName;
    if (tag === "SELECT" || (tag === "INPUT" && e.key.startsWith("Arrow")) || (tag === "BUTTON" && e.key === " ") || (tag === "INPUT" && e.target.type === "checkbox" && e.key === " ")) return;
    e.preventDefault();
    keys[e.key](e);
  });
}

function fillSelect(select, choices, chosen) {
  select.replaceChildren(...choices.map(([value, text]) => make("option", {value, textContent: text, selected: value === chosen})));
}
