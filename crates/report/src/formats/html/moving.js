"use strict";
// Plays the moving pictures of the page. The data say of each item what carries it: a track (origin and turn over time), two tracks between which it is drawn
// anew, or a way over several. Nothing here knows a symbol. The instant is shared with the plots by the event "strutt-instant".
(() => {
  const page = JSON.parse(document.getElementById("strutt-moving").textContent), words = page.words;
  const calm = matchMedia("(prefers-reduced-motion: reduce)");
  const local = (text) => text.replace("-", "−").replace(".", page.mark);
  const round = (x) => Math.round(x * 100) / 100;
  function element(tag, attributes, ...children) {
    const e = document.createElement(tag);
    for (const [key, value] of Object.entries(attributes || {})) e.setAttribute(key, value);
    e.append(...children);
    return e;
  }
  // values as differences in whole steps; a number stands for what does not change
  function unpack(list, step, count) {
    const out = new Float64Array(count);
    if (!Array.isArray(list)) return out.fill(list);
    let sum = 0;
    for (let k = 0; k < count; k++) out[k] = (sum += list[k]) * step;
    return out;
  }
  const dashed = (points, closed) => {
    let d = "";
    for (let i = 0; i < points.length; i += 2) d += (i ? "L" : "M") + round(points[i]) + " " + round(points[i + 1]);
    return closed ? d + "Z" : d;
  };

  function Player(holder, movie) {
    const svg = holder.querySelector("svg"), box = holder.querySelector(".player");
    const count = movie.times.length, [place, angle, moment] = movie.step;
    const times = unpack(movie.times, moment, count).map((s) => movie.first + s * movie.span);
    const tracks = movie.tracks.map((t) => t && { x: unpack(t[0], place, count), y: unpack(t[1], place, count), a: unpack(t[2], angle, count) });
    const items = movie.items.map((item) => {
      const g = svg.querySelector(`[data-item="${item.g}"]`);
      return { ...item, g, paths: [...g.querySelectorAll("path:not(.run)")], run: g.querySelector(".run") };
    });
    const states = movie.states.map(([i, stays]) => ({ g: svg.querySelector(`[data-item="${i}"]`), stays, look: "" }));
    // a lock on what sticks: shown by the style of its state
    for (const { g, stays } of states) {
      if (!stays.some((stay) => stay[2] === "sticks")) continue;
      const lock = document.createElementNS("http://www.w3.org/2000/svg", "path"), area = g.getBBox();
      lock.setAttribute("class", "lock");
      lock.setAttribute("d", `M${round(area.x - 13)} ${round(area.y - 2)}v7h9v-7zm1.5 0v-2.5a3 3 0 0 1 6 0v2.5`);
      g.append(lock);
    }
    const labels = movie.labels.map(([i, a, b, x, y]) => ({ g: svg.querySelector(`[data-label="${i}"]`), a, b, x, y }));
    const last = movie.first + movie.span;
    let now = movie.shown, playing = false, before = 0, told = 0, pace = movie.pace, again = movie.clock.repeats, quiet = false;

    // ---- places at an instant
    let k = 0, share = 0;
    function find(t) {
      let a = 0, b = count - 1;
      while (b - a > 1) { const m = (a + b) >> 1; times[m] <= t ? (a = m) : (b = m); }
      k = a;
      share = count > 1 ? Math.min(1, Math.max(0, (t - times[a]) / (times[a + 1] - times[a]))) : 0;
    }
    const mixed = (list) => list[k] + (list[k + 1] - list[k]) * share;
    const turn = (track) => (tracks[track] ? mixed(tracks[track].a) : 0);
    function image(track, x, y) {
      const t = tracks[track];
      if (!t) return [x, y];
      const a = mixed(t.a), c = Math.cos(a), s = Math.sin(a), dx = x - t.x[0], dy = y - t.y[0];
      return [mixed(t.x) + c * dx + s * dy, mixed(t.y) - s * dx + c * dy];
    }
    // where a thread leaves a drum
    function tangent([cx, cy], r, [fx, fy], sense) {
      const d = Math.hypot(fx - cx, fy - cy), a = Math.atan2(cy - fy, fx - cx) + sense * (d > r ? Math.acos(r / d) : 0);
      return [cx + r * Math.cos(a), cy - r * Math.sin(a)];
    }
    function stretch(item) {
      const [ax, ay] = image(item.ends[0], item.p[0], item.p[1]), [bx, by] = image(item.ends[1], item.p[2], item.p[3]);
      const long = Math.hypot(bx - ax, by - ay), [l0, l1] = item.l;
      const f = l1 - l0 > 0.02 ? (long - l0) / (l1 - l0) : 0;
      const ux = long > 1e-9 ? (bx - ax) / long : 1, uy = long > 1e-9 ? (by - ay) / long : 0;
      item.paths.forEach((path, j) => {
        const near = item.d[0][j], far = item.d[1][j], points = new Array(near.length);
        for (let i = 0; i < near.length; i += 2) {
          const x = near[i] + (far[i] - near[i]) * f, y = near[i + 1] + (far[i + 1] - near[i + 1]) * f;
          points[i] = ax + ux * x - uy * y;
          points[i + 1] = ay + uy * x + ux * y;
        }
        path.setAttribute("d", dashed(points, item.closed[j]));
      });
    }
    function way(item) {
      const points = item.way.map((via) => image(via[0], via[1], via[2]));
      item.way.forEach((via, i) => {
        if (via.length > 3) points[i] = tangent(points[i], via[3], points[i ? i - 1 : 1] || points[i], via[4]);
      });
      item.paths[0].setAttribute("d", dashed(points.flat(), item.closed));
    }
    function draw() {
      find(now);
      for (const item of items) {
        if (item.way) way(item);
        else if (item.ends) stretch(item);
        else {
          const [x, y] = item.p, [cx, cy] = image(item.on[0], x, y);
          item.g.setAttribute("transform", `translate(${round(cx)} ${round(cy)}) rotate(${round(-turn(item.on[1]) * 57.29577951)}) translate(${-x} ${-y})`);
        }
        if (item.run) item.run.style.strokeDashoffset = round(item.runs[1] * turn(item.runs[0]));
      }
      for (const state of states) {
        const stay = state.stays.find(([from, to]) => from <= now && now < to), look = stay ? stay[2] : "";
        if (look !== state.look) state.g.setAttribute("class", (state.look = look));
      }
      for (const label of labels) {
        const [ax, ay] = image(label.a, label.x, label.y), [bx, by] = label.a === label.b ? [ax, ay] : image(label.b, label.x, label.y);
        label.g.setAttribute("transform", `translate(${round((ax + bx) / 2 - label.x)} ${round((ay + by) / 2 - label.y)})`);
      }
    }

    // ---- controls
    const decimals = Math.max(0, 2 - Math.floor(Math.log10(movie.span)));
    const shown = (t) => `${movie.clock.symbol} = ${local(t.toFixed(Math.min(9, decimals)))}${movie.clock.unit ? "\u00a0" + movie.clock.unit : ""}`;
    const named = (p) => (movie.clock.name !== "t" ? `${local(String(+p.toPrecision(2)))}\u00a0${movie.clock.unit}/${page.mark === "," ? "с" : "s"}`
      : p >= 1 ? `×${local(String(+p.toPrecision(2)))}` : `×1/${local(String(+(1 / p).toPrecision(2)))}`);
    const button = element("button", { type: "button", class: "go" });
    const scrub = element("input", { type: "range", min: 0, max: 1000, step: 1, value: 0, "aria-label": words.instant });
    const clock = element("output", {});
    const speed = element("select", { "aria-label": words.pace, title: words.pace });
    for (const factor of [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10]) {
      const option = element("option", { value: factor * movie.pace }, named(factor * movie.pace));
      if (factor === 1) option.selected = true;
      speed.append(option);
    }
    const repeat = element("button", { type: "button", "aria-label": words.repeat, title: words.repeat, "aria-pressed": again }, "↻");
    box.append(button, scrub, clock, speed, repeat);
    holder.title = words.help;
    function face() {
      button.textContent = playing ? "❚❚" : "▶";
      button.setAttribute("aria-label", playing ? words.pause : words.play);
      button.title = playing ? words.pause : words.play;
    }
    function tell() {
      const text = shown(now);
      if (clock.textContent !== text) clock.textContent = text;
      scrub.value = 1000 * (now - movie.first) / movie.span;
      scrub.setAttribute("aria-valuetext", text);
    }
    function announce() {
      quiet = true;
      document.dispatchEvent(new CustomEvent("strutt-instant", { detail: { clock: movie.clock.name, t: now, from: holder } }));
      quiet = false;
    }
    function seek(t) {
      now = Math.min(last, Math.max(movie.first, t));
      draw();
      tell();
    }
    function frame(stamp) {
      if (!playing) return;
      let next = now + Math.min(0.1, (stamp - before) / 1000) * pace;
      before = stamp;
      if (next >= last) {
        if (again) next = movie.first + ((next - movie.first) % movie.span);
        else { next = last; stop(); }
      }
      seek(next);
      // plots follow ten times a second
      if (stamp - told > 100 || !playing) { told = stamp; announce(); }
      if (playing) requestAnimationFrame(frame);
    }
    function play() {
      if (now >= last) now = movie.first;
      playing = true;
      face();
      requestAnimationFrame((stamp) => { before = stamp; frame(stamp); });
    }
    function stop() { playing = false; face(); }
    function jump(t) { seek(t); announce(); }
    // a step is a frame of the film, not of the data
    const step = () => pace / 25;
    button.onclick = () => (playing ? stop() : play());
    scrub.oninput = () => { stop(); jump(movie.first + movie.span * scrub.value / 1000); };
    speed.onchange = () => { pace = +speed.value; };
    repeat.onclick = () => { again = !again; repeat.setAttribute("aria-pressed", again); };
    holder.addEventListener("keydown", (e) => {
      if (e.ctrlKey || e.altKey || e.metaKey || e.target === speed) return;
      const size = e.shiftKey ? 10 : 1;
      const keys = {
        Space: () => (playing ? stop() : play()), ArrowLeft: () => { stop(); jump(now - size * step()); }, ArrowRight: () => { stop(); jump(now + size * step()); },
        Home: () => { stop(); jump(movie.first); }, End: () => { stop(); jump(last); },
      };
      const act = keys[e.code];
      if (act && !(e.code === "Space" && e.target === repeat)) { e.preventDefault(); act(); }
    });
    document.addEventListener("strutt-instant", (e) => {
      if (!quiet && !playing && e.detail.from !== holder && e.detail.clock === movie.clock.name && e.detail.t != null) seek(e.detail.t);
    });
    addEventListener("beforeprint", () => { stop(); seek(movie.shown); });
    box.hidden = false;
    face();
    seek(movie.shown);
    // once, when it is first seen; nobody who wants calm
    if (!calm.matches) {
      const eye = new IntersectionObserver((seen) => {
        if (!seen.some((s) => s.isIntersecting)) return;
        eye.disconnect();
        play();
      }, { threshold: 0.6 });
      eye.observe(svg);
    }
    // nothing is computed for what nobody sees
    document.addEventListener("visibilitychange", () => { if (document.hidden) stop(); });
    return { seek, play, stop };
  }

  const players = [];
  document.querySelectorAll("figure[data-moving]").forEach((holder) => {
    try { players.push(Player(holder, page.movies[holder.dataset.moving])); } catch (error) {
      // a picture that cannot be played stays a picture
      console.error(error);
    }
  });
  window.struttPlayers = players;
})();
