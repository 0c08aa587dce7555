// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// The page of a sweep in a real browser:   node tests/browser/sweep.mjs YOKE FOLDER [SCREENSHOTS]
// As report.mjs: a line a check; exit code 1 if one fails.
import {execFileSync} from "node:child_process";
import {existsSync, mkdirSync} from "node:fs";
import {join} from "node:path";
import {Chrome} from "./chrome.mjs";

const [, , yoke, folder, pictures] = process.argv;
let failed = 0;
function check(what, ok, value = "") {
  console.log(`${ok ? "ok    " : "FAILED"} ${what}${value === "" ? "" : `: ${value}`}`);
  if (!ok) ++failed;
}

function sweep(name, ...options) {
  const output = join(folder, name);
  execFileSync(yoke, ["sweep", "slider_crank", "--samples", "101", "--set", "rod=100mm", ...options, "-o", output], {stdio: "ignore"});
  return output;
}

const chrome = await Chrome.start();
const app = (code) => chrome.evaluate(`(() => { const app = window.yokeSweep; return (${code}); })()`);
const frame = () => chrome.evaluate("new Promise((r) => requestAnimationFrame(() => requestAnimationFrame(() => r(1))))");
const placeOf = (selector) => chrome.evaluate(`(() => { const e = document.querySelector(${JSON.stringify(selector)}); e.scrollIntoView({block: "center"});
  const r = e.getBoundingClientRect(); return {x: r.left, y: r.top, width: r.width, height: r.height}; })()`);
const text = (id) => chrome.evaluate(`document.getElementById("${id}").textContent`);
const colours = (id) => chrome.evaluate(`(() => { const c = document.getElementById("${id}"); const d = c.getContext("2d").getImageData(0, 0, c.width, c.height).data;
  const seen = new Set(); for (let i = 0; i < d.length; i += 4) if (d[i + 3]) seen.add(d[i] * 65536 + d[i + 1] * 256 + d[i + 2]); return seen.size; })()`);
async function picture(name) {
  if (!pictures) return;
  mkdirSync(pictures, {recursive: true});
  await chrome.screenshot(join(pictures, `${name}.png`));
}

try {
  const grid = sweep("sweep_grid", "--vary", "crank=20mm:120mm:6", "--vary", "speed=100:500:5", "--keep-runs");
  await chrome.size(1400, 1200);
  await chrome.theme("light");
  const seconds = await chrome.open(join(grid, "report.html"));
  check("opens in less than 2 s", seconds < 2, `${seconds} s`);
  check("holds all points", await app("app.sweep.rows") === 30, await app("app.sweep.rows"));
  check("knows the grid", await app("app.sweep.isGrid"));
  for (const id of ["parallel", "map", "curves"]) check(`${id} is drawn`, await colours(id) > 8, await colours(id));

  // A click into the cell of crank = 60 mm, speed = 300: row 2 * 5 + 2.
  const map = await placeOf("#map");
  const [x, y] = await app("[app.map.xs.place(60), app.map.ys.place(300)]");
  await chrome.click(map.x + x, map.y + y);
  await frame();
  check("a click on the map selects its point", await app("app.selected") === 12, await app("app.selected"));
  const shown = await text("point");
  check("its command is shown", shown.includes("yoke run slider_crank --set rod=100mm --set crank=60mm --set speed=300"));
  const link = await chrome.evaluate('document.querySelector("#point a").getAttribute("href")');
  check("its run's report is there", existsSync(join(grid, link)), link);
  await picture("sweep");

  const curves = await placeOf("#curves");
  const [u, v] = await app("[app.curves.xs.place(app.sweep.axes[0].values[7]), app.curves.ys.place(app.colour.values[7])]");
  await chrome.click(curves.x + u, curves.y + v);
  await frame();
  check("a click on a curve selects its point", await app("app.selected") === 7, await app("app.selected"));
  await chrome.key("ArrowRight", "ArrowRight", "");
  await frame();
  check("an arrow key goes on", await app("app.selected") === 8, await app("app.selected"));

  const parallel = await placeOf("#parallel");
  const [a, top, bottom] = await app("[app.parallel.scales[0].x, app.parallel.scales[0].scale.place(45), app.parallel.scales[0].scale.place(30)]");
  await chrome.drag(parallel.x + a, parallel.y + top, parallel.x + a, parallel.y + bottom);
  await frame();
  check("a drag along an axis keeps what is within", await app("app.rows().length") === 5, await app("app.rows().length"));
  check("and says so", (await text("count")) === "5 of 30 points", await text("count"));
  await chrome.click(parallel.x + a, parallel.y + (top + bottom) / 2);
  await frame();
  check("a click on the axis takes all", await app("app.rows().length") === 30);

  const failures = await app("app.sweep.failures");
  check("what failed is listed with its reason", failures === 10 && (await text("failures")).includes("must be longer than the crank"), failures);
  const before = await app("app.colour.name");
  await chrome.evaluate('(() => { const s = document.getElementById("colour"); s.value = [...s.options].find((o) => o.textContent === "steps").value; s.dispatchEvent(new Event("change")); })()');
  await frame();
  check("another quantity may colour", before === "peak_force" && await app("app.colour.name") === "steps");

  const one = sweep("sweep_one", "--vary", "crank=20mm:60mm:9");
  await chrome.open(join(one, "report.html"));
  check("one parameter: curves without a map", await chrome.evaluate('document.getElementById("map-section").hidden') && await colours("curves") > 8);
  const random = sweep("sweep_random", "--vary", "crank=20mm:90mm", "--vary", "speed=100:500", "--random", "60");
  await chrome.open(join(random, "report.html"));
  check("random points are dots", !(await app("app.sweep.isGrid")) && await colours("map") > 8);
  await picture("sweep_random");

  await chrome.theme("dark");
  await chrome.open(join(grid, "report.html") + "#point=12");
  check("an address leads to a point", await app("app.selected") === 12, await app("app.selected"));
  await picture("sweep_dark");
  check("no errors on the console", chrome.messages.length === 0, chrome.messages.join("; "));
} finally {
  await chrome.stop();
}
console.log(failed ? `${failed} checks failed` : "all checks passed");
process.exit(failed ? 1 : 0);
