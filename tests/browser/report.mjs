// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
//
// A report in a real browser:   node tests/browser/report.mjs YOKE FOLDER [SCREENSHOTS]
// Runs cases with the program YOKE, results into FOLDER, and uses their pages as a user would. Prints
// a line a check; exit code 1 if one fails.
import {execFileSync} from "node:child_process";
import {mkdirSync, statSync} from "node:fs";
import {join} from "node:path";
import {Chrome} from "./chrome.mjs";

const [, , yoke, folder, pictures] = process.argv;
let failed = 0;
function check(what, ok, value = "") {
  console.log(`${ok ? "ok    " : "FAILED"} ${what}${value === "" ? "" : `: ${value}`}`);
  if (!ok) ++failed;
}

function results(name, ...options) {
  const output = join(folder, name);
  execFileSync(yoke, ["run", ...options, "--no-plots", "-o", output], {stdio: "ignore"});
  return output;
}

const chrome = await Chrome.start();
const app = (code) => chrome.evaluate(`(() => { const app = window.yoke.app; return (${code}); })()`);
const wait = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
const frame = () => chrome.evaluate("new Promise((r) => requestAnimationFrame(() => requestAnimationFrame(() => r(1))))");
const placeOf = (selector) => chrome.evaluate(`(() => { const e = document.querySelector(${JSON.stringify(selector)}); e.scrollIntoView({block: "center"});
  const r = e.getBoundingClientRect(); return {x: r.left, y: r.top, width: r.width, height: r.height}; })()`);
const clickOn = async (selector) => { const r = await placeOf(selector); await chrome.click(r.x + r.width / 2, r.y + r.height / 2); await frame(); };
// What a canvas shows, as a number.
const look = (id) => chrome.evaluate(`(() => { const c = document.getElementById("${id}"); const d = c.getContext("2d").getImageData(0, 0, c.width, c.height).data;
  let h = 0; for (let i = 0; i < d.length; i += 4) h = (h * 31 + d[i] + 7 * d[i + 1] + 13 * d[i + 2]) >>> 0; return h; })()`);
const colored = (id, test) => chrome.evaluate(`(() => { const c = document.getElementById("${id}"); const d = c.getContext("2d").getImageData(0, 0, c.width, c.height).data;
  let n = 0; for (let i = 0; i < d.length; i += 4) { const [r, g, b] = [d[i], d[i + 1], d[i + 2]]; if (${test}) ++n; } return n; })()`);
async function picture(name) {
  if (!pictures) return;
  mkdirSync(pictures, {recursive: true});
  await wait(400);
  await chrome.screenshot(join(pictures, `${name}.png`));
}

try {
  // ---- the main job: a contact with clearance under two laws ----
  const main = results("scotch_yoke", "scotch_yoke", "--law", "table11-johnson", "--law", "johnson");
  const page = join(main, "report.html");
  await chrome.size(1400, 1000);
  await chrome.theme("light");
  const seconds = await chrome.open(page);
  check("opens in less than 2 s", seconds < 2, `${seconds} s`);
  check("is smaller than 7.5 MB", statSync(page).size < 7.5e6, `${statSync(page).size} bytes`);

  const rows = await chrome.evaluate(`(() => { const box = document.getElementById("contacts"), last = box.querySelector("tbody tr:nth-last-child(2)");
    return last.offsetTop + last.offsetHeight - box.clientHeight; })()`);
  check("the table of contacts is full from the start", rows >= 0, `${rows} px beyond its box`);
  const before = await look("mechanism"), start = await app("app.time");
  await clickOn("#play");
  await wait(700);
  check("play moves the time", await app("app.time") > start, await app("app.time"));
  check("play moves the mechanism", await look("mechanism") !== before);
  await chrome.key(" ", "Space", " ");
  check("space pauses", await app("app.playing") === false);

  const scrub = await placeOf("#scrub");
  const cursor = () => app("app.timePlots[0].plot.cursor.left");
  const cursorBefore = await cursor();
  await chrome.click(scrub.x + scrub.width * 0.7, scrub.y + scrub.height / 2);
  await frame();
  const share = await app("(app.time - app.run.start) / (app.run.end - app.run.start)");
  check("scrubbing sets the time", Math.abs(share - 0.7) < 0.05, share);
  check("scrubbing moves the cursor of the plots", Math.abs(await cursor() - cursorBefore) > 5, await cursor());
  const shown = await app("app.timePlots[0].plot.posToVal(app.timePlots[0].plot.cursor.left, 'x')");
  check("the cursor is at the time of the animation", Math.abs(shown - await app("app.time")) < 1e-3 * await app("app.run.end"), shown);

  const over = await placeOf(".plot .u-over");
  await chrome.drag(over.x + over.width * 0.3, over.y + 60, over.x + over.width * 0.4, over.y + 60);
  await frame();
  const scale = (i) => app(`[app.timePlots[${i}].plot.scales.x.min, app.timePlots[${i}].plot.scales.x.max]`);
  const [from, to] = await scale(0), end = await app("app.run.end");
  check("dragging zooms the time axis", Math.abs((to - from) / end - 0.1) < 0.02, [from, to]);
  check("of the other plots too", JSON.stringify(await scale(1)) === JSON.stringify([from, to]));
  await chrome.click(over.x + over.width * 0.5, over.y + 60, 2);
  await frame();
  check("a double click resets it", Math.abs((await scale(0))[1] - end) < 1e-9 * end, await scale(0));

  const series = () => app("app.timePlots[0].plot.series.length");
  const count = await series();
  await clickOn(".plot .legend button");
  check("the legend hides a series", await series() === count - 1);
  await clickOn(".plot .legend button");
  check("and shows it again", await series() === count);

  const row = 3, onset = await app(`app.table.rows[${row}].t`);
  await clickOn(`#contacts tbody tr.jump:nth-child(${row + 2})`);
  check("a click on a contact goes there", await app("app.time") === onset, onset);
  await chrome.key("n");
  await frame();
  check("n goes to the next event", await app("app.time") > onset, await app("app.time"));
  const impacts = await app("app.run.impacts.map((i) => [i.speed, i.peak, i.restitution])");
  check("contacts have speed, peak force, restitution", impacts.length > 10 && impacts.every(([v, F, e]) => v >= 0 && F > 0 && (e === null || e > 0)), impacts.length);

  await app("app.seek(app.run.impacts.reduce((a, b) => (b.peak > a.peak ? b : a)).onset + 1e-9)");
  await frame();
  const hot = "r > 180 && g < 90 && b < 90";
  const gapText = await chrome.evaluate("document.getElementById('lens-text').textContent");
  const lensBefore = await colored("lens", hot);
  await app("(() => { const i = app.run.impacts.reduce((a, b) => (b.peak > a.peak ? b : a)); app.seek((i.onset + i.release) / 2); })()");
  await frame();
  const text = await chrome.evaluate("document.getElementById('lens-text').textContent");
  check("the lens names the penetration", /penetration [0-9.]+ (\u00b5m|nm)/.test(text), text.replace("\n", ", "));
  check("and shows it in colour", await colored("lens", hot) > lensBefore + 50, `${lensBefore} to ${await colored("lens", hot)} pixels (${gapText.split("\n")[0]})`);
  await app("app.seek((() => { const c = app.run.column('slot.penetration').values; let k = 0; for (let i = 0; i < c.length; ++i) if (c[i] < c[k]) k = i; return app.run.t[k]; })())");
  await frame();
  check("the lens shows the gap", /gap (9|10)[0-9.]* \u00b5m/.test(await chrome.evaluate("document.getElementById('lens-text').textContent")), await chrome.evaluate("document.getElementById('lens-text').textContent.split('\\n')[0]"));

  const zoomed = await app("app.camera.scale");
  const stage = await placeOf("#mechanism");
  await chrome.send("Input.dispatchMouseEvent", {type: "mouseWheel", x: stage.x + 100, y: stage.y + 100, deltaX: 0, deltaY: -300});
  await frame();
  check("the wheel zooms the mechanism", await app("app.camera.scale") > 1.2 * zoomed);
  const x = await app("app.camera.x");
  await chrome.drag(stage.x + 200, stage.y + 200, stage.x + 260, stage.y + 200);
  check("dragging pans it", Math.abs(await app("app.camera.x") - x) > 1e-6);
  await chrome.evaluate("(() => { const f = document.getElementById('follow'); f.value = '1'; f.dispatchEvent(new Event('change')); })()");
  await app("app.seek(app.run.start + 0.01)");
  await frame();
  const followed = await app("app.camera.x");
  await app("app.seek(app.run.start + 0.02)");
  await frame();
  check("the view follows a body", await app("app.camera.x") !== followed);

  const names = await app("app.runs.map((r) => r.label)");
  check("both laws are there", names.length === 2, names);
  await placeOf("#plots");
  await wait(300);
  await clickOn("#run-chips label:nth-child(2) input");
  await frame();
  check("a second run is laid over the first", await series() === 3, await series());
  await clickOn("#difference");
  check("and their difference is drawn", (await app("app.timePlots[0].heading.textContent")).includes("difference") && await series() === 2);
  check("no error on the console", chrome.messages.length === 0, chrome.messages.join("; "));
  check("nothing was asked of a network", chrome.requests.every((u) => u.startsWith("file:") || u.startsWith("about:") || u.startsWith("data:")), chrome.requests.filter((u) => !u.startsWith("file:")).join(" "));

  // ---- runs beside one another, and stretches that the case names ----
  const comparison = join(folder, "both", "comparison.html");
  execFileSync(yoke, ["compare", main, "-o", join(folder, "both")], {stdio: "ignore"});
  await chrome.open(comparison);
  check("a comparison plots all its runs", await app("app.plotted().length") === 2);
  check("and says what differs", /law.*table11-johnson.*johnson.*peak force/s.test(await chrome.evaluate("document.getElementById('comparison').textContent")));
  await placeOf("#plots");
  await wait(300);
  await clickOn("#side");
  check("side by side: a panel a run", await app("app.timePlots[0].plots.length") === 2);
  await chrome.evaluate("(() => { const v = document.getElementById('view'); v.value = '0'; v.dispatchEvent(new Event('change')); })()");
  await frame();
  const heights = await app("app.timePlots[0].plots.map((p) => p.scales.y.max)");
  check("on one scale", heights[0] === heights[1] && heights[0] > 1, heights);
  check("of the stretch that is asked for", Math.abs(await app("app.timePlots[0].plots[1].scales.x.min") - 1 / 12) < 1e-6);
  await picture("comparison");

  // ---- eight runs: the mechanism at once, plots as they come into view ----
  const eight = results("eight", "scotch_yoke");
  execFileSync(yoke, ["compare", eight, "-o", join(folder, "all")], {stdio: "ignore"});
  const times = [];
  for (let i = 0; i < 5; ++i) times.push(await chrome.open(join(folder, "all", "comparison.html")));
  const median = [...times].sort((a, b) => a - b)[2];
  check("a comparison of eight runs opens in less than 2 s, the median of five", median < 2, `${median} s of ${times.join(", ")}`);
  await chrome.evaluate("window.scrollTo(0, 0)");
  await frame();
  check("what is far below is not drawn yet", await app("app.xyPlots.every((p) => p.stale) && app.xyPlots.length > 2"));
  await placeOf("#plots .xy-grid");
  await wait(700);
  check("until it comes into view", await app("app.xyPlots.some((p) => p.seen && !p.stale && p.spec.lines.length >= 8)"));
  chrome.messages.length = 0;
  await app("app.buildAll()");
  check("printing draws all of it", await app("app.allPlots().every((p) => !p.stale)") && chrome.messages.length === 0, chrome.messages.join("; "));

  // ---- every mechanism alone: all of it in the picture, its names beside one another ----
  const list = execFileSync(yoke, ["list"], {encoding: "utf8"}).split("Laws of")[0];
  const cases = [...list.matchAll(/^  (\w+) +\S/gm)].map((m) => m[1]);
  check("all cases are there", cases.length > 20, cases.length);
  await chrome.size(900, 640);
  for (const name of cases) {
    execFileSync(yoke, ["view", name, "-o", join(folder, "views", name)], {stdio: "ignore"});
    chrome.messages.length = 0;
    await chrome.open(join(folder, "views", name, "view.html"));
    await clickOn("#names");
    const boxes = await app("app.run.boxesOfNames");
    const bodies = await app("app.run.drawing.bodies.length - 1");
    const {width, height} = await app("({width: app.camera.width, height: app.camera.height})");
    const outside = boxes.filter(([a, b, c, d]) => a < 0 || b > width || c < 0 || d > height).length;
    const over = boxes.filter(([a, b, c, d], i) => boxes.slice(0, i).some((t) => a < t[1] && b > t[0] && c < t[3] && d > t[2])).length;
    check(`${name}: names are within the picture and apart`, boxes.length >= bodies && outside === 0 && over === 0, `${boxes.length} names, ${outside} outside, ${over} over others`);
    // A wall without ends is seen where a disc may meet it.
    const unseen = await app(`(() => {
      const {shapes, bodies} = app.run.drawing;
      const poses = bodies.map((b, i) => ["x", "y", "angle"].map((q) => (i > 0 ? app.run.column(b.name + "." + q).values[0] : 0)));
      const turned = ([, , a], x, y) => [Math.cos(a) * x - Math.sin(a) * y, Math.sin(a) * x + Math.cos(a) * y];
      const pointOf = (pose, x, y) => { const [u, v] = turned(pose, x, y); return [pose[0] + u, pose[1] + v]; };
      return shapes.filter((l) => l.kind === "line" && l.role === "contact").filter((l) => {
        const disc = shapes.find((d) => d.kind === "disc" && d.element === l.element);
        const p = pointOf(poses[l.body], l.points[0], l.points[1]), u = turned(poses[l.body], l.points[2], l.points[3]);
        const c = pointOf(poses[disc.body], disc.points[0], disc.points[1]);
        const along = (c[0] - p[0]) * u[0] + (c[1] - p[1]) * u[1];
        const [x, y] = app.camera.screen([p[0] + along * u[0], p[1] + along * u[1]]);
        return x < 0 || x > app.camera.width || y < 0 || y > app.camera.height;
      }).length; })()`);
    check(`${name}: its walls are seen, without an error`, unseen === 0 && chrome.messages.length === 0, chrome.messages.join("; "));
    await picture(`view-${name}`);
  }
  await chrome.size(1400, 1000);

  // ---- a mechanism alone ----
  execFileSync(yoke, ["view", "newtons_cradle", "-o", join(folder, "drawn")], {stdio: "ignore"});
  chrome.messages.length = 0;
  await chrome.open(join(folder, "drawn", "view.html"));
  check("a view shows the mechanism without a run", await chrome.evaluate("document.getElementById('plots-section').hidden") && chrome.messages.length === 0, chrome.messages.join("; "));
  await picture("view");

  // ---- how it looks: light, dark, narrow ----
  await chrome.open(page);
  await app("app.seek(app.run.impacts[3].onset + 1e-4)");
  await picture("scotch_yoke-light");
  await chrome.theme("dark");
  await chrome.open(page);
  check("dark if the system is", await chrome.evaluate("document.documentElement.classList.contains('dark')"));
  await app("app.seek(app.run.impacts[3].onset + 1e-4)");
  await picture("scotch_yoke-dark");
  await chrome.key("t");
  check("t changes to light", !(await chrome.evaluate("document.documentElement.classList.contains('dark')")));
  await chrome.theme("light");
  await chrome.size(360, 740);
  await chrome.open(page);
  check("at 360 px nothing is wider than the page", await chrome.evaluate("document.documentElement.scrollWidth") <= 360, await chrome.evaluate("document.documentElement.scrollWidth"));
  await picture("scotch_yoke-narrow");
  await chrome.size(1400, 1000);

  // ---- other machines ----
  for (const name of ["geneva", "cam_follower", "slider_crank_clearance", "jansen_leg", "ratchet", "cpva"]) {
    chrome.messages.length = 0;
    const file = join(results(name, name), "report.html");
    const opened = await chrome.open(file);
    await app("(() => { const i = app.run.impacts[Math.floor(app.run.impacts.length / 2)]; app.seek(i ? (i.onset + i.release) / 2 : 0.4 * app.run.end); })()");
    await frame();
    await app("app.buildAll()");
    check(`${name}: opens in less than 2 s`, opened < 2, `${opened} s, ${statSync(file).size} bytes`);
    check(`${name}: smaller than 15 MB, without an error`, statSync(file).size < 15e6 && chrome.messages.length === 0, chrome.messages.join("; "));
    const choices = "['run-choice', 'run-chips', 'side-label', 'difference-label'].every((id) => (document.getElementById(id).offsetHeight > 0) === (app.runs.length > 1))";
    check(`${name}: a choice of runs only where there are several`, await app(choices), await app("app.runs.length"));
    const drawn = await chrome.evaluate("new Set(window.yoke.app.run.drawing.shapes.map((s) => s.element)).size");
    check(`${name}: elements are drawn`, drawn > 1, drawn);
    await picture(name);
  }
} finally {
  await chrome.stop();
}
console.log(failed ? `${failed} checks failed` : "all checks passed");
process.exit(failed ? 1 : 0);
