"use strict";
(() => {
  const data = JSON.parse(document.getElementById("explored").textContent);
  const root = document.getElementById("explore");
  const canvas = root.querySelector(".stage canvas");
  const gl = canvas.getContext("webgl2", { antialias: false });
  if (!gl) return;
  const linear = gl.getExtension("OES_texture_float_linear");
  const drawable = (lobe) => lobe.approximations.filter((one) => !one.texels || one.texels.format === "f16" || linear);
  const lobes = data.effects.flatMap((effect) => effect.shown).filter((lobe) => drawable(lobe).length > 0);
  if (lobes.length === 0) return;
  document.getElementById("unable").hidden = true;
  document.getElementById("still").hidden = true;
  root.hidden = false;
  canvas.addEventListener("webglcontextlost", () => location.reload());

  const METALS = { white: [1, 1, 1], gold: [1, 0.78, 0.34], copper: [0.95, 0.64, 0.54], iron: [0.56, 0.57, 0.58] };
  const GRID = 128; // places along each axis where errors are measured
  const UNITS = { texels: 0, truth_texels: 1, ramp: 2 };
  const find = (list, name) => list.find((one) => one.name === name);
  const bytes = (base64) => Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const control = (name) => root.querySelector(`[name=${name}]`);
  const make = (tag, text, within) => {
    const element = document.createElement(tag);
    element.textContent = text;
    return within.appendChild(element);
  };
  const figure = (x) => (x === 0 ? "0" : Math.abs(x) < 1e-4 ? x.toExponential(1) : Number(x.toPrecision(4)).toString()).replace("-", "\u2212");
  const signed = (x) => (x > 0 ? "+" : "") + figure(x);

  // What the page shows; the address has the same.
  const state = { lobe: lobes[0].name, a: "", b: "", roughness: 0.9, f0: [1, 1, 1], under: "furnace", times: 50 };
  const light = [-0.45, 0.6, 0.66];
  const lobe = () => find(lobes, state.lobe);
  const offered = () => drawable(lobe());
  const chosen = (side) => find(offered(), state[side]);

  // The nearest state that can be drawn.
  const settle = () => {
    if (!lobe()) state.lobe = lobes[0].name;
    const { drawn, f0, truth } = lobe();
    const all = offered();
    const of = (...standings) => all.find((one) => standings.includes(one.standing));
    const any = all[all.length - 1];
    if (!chosen("b")) state.b = (of("emitted") || of("table") || of("frontier") || any || {}).name;
    if (!chosen("a")) state.a = (of("without") || of("published") || all[0] || {}).name;
    const [low, high] = truth.roughness;
    state.roughness = Math.min(Math.max(state.roughness, low), high);
    if (drawn !== "compensation" && new Set(state.f0).size > 1) state.f0 = [f0, f0, f0];
  };
  const take = (text) => {
    const given = new URLSearchParams(text);
    for (const word of ["lobe", "a", "b", "under"]) if (given.has(word)) state[word] = given.get(word);
    for (const word of ["roughness", "times"]) if (Number.isFinite(parseFloat(given.get(word)))) state[word] = parseFloat(given.get(word));
    const f0 = (given.get("f0") || "").split(",").map(parseFloat).filter((x) => x >= 0 && x <= 1);
    if (f0.length === 1) state.f0 = [f0[0], f0[0], f0[0]];
    else if (f0.length === 3) state.f0 = f0;
    else if (given.has("lobe") && lobe()) state.f0 = Array(3).fill(lobe().f0);
    if (![10, 50, 100].includes(state.times)) state.times = 50;
    if (state.under !== "light") state.under = "furnace";
  };
  const address = () => {
    const f0 = new Set(state.f0).size === 1 ? state.f0[0] : state.f0.join(",");
    return "#" + new URLSearchParams({ ...state, f0 }).toString();
  };

  // Textures and programs, each made once.
  const texture = (unit, [width, height], [internal, format, type], pixels, filter) => {
    const made = gl.createTexture();
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, made);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.texImage2D(gl.TEXTURE_2D, 0, internal, width, height, 0, format, type, pixels);
    for (const name of ["MIN_FILTER", "MAG_FILTER"]) gl.texParameteri(gl.TEXTURE_2D, gl["TEXTURE_" + name], filter);
    for (const name of ["WRAP_S", "WRAP_T"]) gl.texParameteri(gl.TEXTURE_2D, gl["TEXTURE_" + name], gl.CLAMP_TO_EDGE);
    return made;
  };
  const once = (make) => {
    const known = new Map();
    return (...key) => {
      const name = key.map((one) => one.name || one).join(" ");
      if (!known.has(name)) known.set(name, make(...key));
      return known.get(name);
    };
  };
  const truthTexels = once(({ truth: { size, data, ranges } }) => {
    const layout = ranges.length === 1 ? [gl.R16UI, gl.RED_INTEGER] : [gl.RG16UI, gl.RG_INTEGER];
    return texture(1, size, [...layout, gl.UNSIGNED_SHORT], new Uint16Array(bytes(data).buffer), gl.NEAREST);
  });
  const tableTexels = once(({ texels: { size, channels, format, data } }) => {
    const layout = { f16: [gl.R16F, gl.RG16F], f32: [gl.R32F, gl.RG32F] }[format][channels - 1];
    const numbers = format === "f16" ? Uint16Array : Float32Array;
    const type = format === "f16" ? gl.HALF_FLOAT : gl.FLOAT;
    return texture(0, size, [layout, [gl.RED, gl.RG][channels - 1], type], new numbers(bytes(data).buffer), gl.LINEAR);
  });
  texture(2, [255, 1], [gl.RGB8, gl.RGB, gl.UNSIGNED_BYTE], bytes(data.ramp), gl.LINEAR);

  const shader = (kind, text) => {
    const made = gl.createShader(kind);
    gl.shaderSource(made, text);
    gl.compileShader(made);
    return made;
  };
  const corners = "#version 300 es\nvoid main() { gl_Position = vec4(vec2((gl_VertexID << 1) & 2, gl_VertexID & 2) * 2.0 - 1.0, 0.0, 1.0); }";
  const vertex = shader(gl.VERTEX_SHADER, corners);
  const program = once((of, { text, call, texels }, measure) => {
    const drawn = typeof of.drawn === "string" ? [of.drawn] : Object.entries(of.drawn)[0];
    const source = [
      "#version 300 es",
      "precision highp float; precision highp int; precision highp sampler2D;",
      ...[...drawn, of.smith, ...(measure === "measure" ? ["measure"] : [])].map((word) => `#define LIVE_${word.toUpperCase()}`),
      `#define LIVE_ALPHA(roughness) (${of.alpha})`,
      texels ? "uniform sampler2D live_texels;" : "",
      text,
      `float live_approximation(float roughness, float alpha, float mu, float f0) { float n_dot_v = mu; return ${call}; }`,
      document.getElementById("shader").textContent,
    ].join("\n");
    const made = gl.createProgram();
    const fragment = shader(gl.FRAGMENT_SHADER, source);
    gl.attachShader(made, vertex);
    gl.attachShader(made, fragment);
    gl.linkProgram(made);
    if (!gl.getProgramParameter(made, gl.LINK_STATUS)) console.error(gl.getShaderInfoLog(fragment) || gl.getProgramInfoLog(made));
    const places = {};
    const count = gl.getProgramParameter(made, gl.ACTIVE_UNIFORMS);
    for (let i = 0; i < count; i++) {
      const { name } = gl.getActiveUniform(made, i);
      places[name.replace("live_", "")] = gl.getUniformLocation(made, name);
    }
    return { made, places };
  });
  // Makes a program current, with what all pictures of a quantity share.
  const using = (approximation, measure) => {
    const { truth } = lobe();
    const { made, places } = program(lobe(), approximation, measure);
    gl.useProgram(made);
    for (const [name, unit] of Object.entries(UNITS)) if (places[name]) gl.uniform1i(places[name], unit);
    gl.activeTexture(gl.TEXTURE1);
    gl.bindTexture(gl.TEXTURE_2D, truthTexels(lobe()));
    if (approximation.texels) {
      const own = tableTexels(approximation);
      gl.activeTexture(gl.TEXTURE0);
      gl.bindTexture(gl.TEXTURE_2D, own);
    }
    gl.uniform2i(places.truth_size, ...truth.size);
    gl.uniform4f(places.truth_domain, ...truth.roughness, ...truth.mu);
    gl.uniform4f(places.truth_range, ...truth.ranges[0], ...(truth.ranges[1] || [0, 0]));
    gl.uniform3f(places.f0, ...state.f0);
    return places;
  };

  // Value, truth, error of the light, and light, at n places of roughness times m of y, mu = low + (high - low) y^2.
  const target = gl.createTexture();
  const frame = gl.createFramebuffer();
  gl.activeTexture(gl.TEXTURE3);
  gl.bindTexture(gl.TEXTURE_2D, target);
  gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA32UI, GRID, GRID);
  const measured = (approximation, span, [n, m]) => {
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, target, 0);
    gl.disable(gl.SCISSOR_TEST);
    gl.viewport(0, 0, n, m);
    const places = using(approximation, "measure");
    gl.uniform4f(places.span, ...span);
    gl.uniform2f(places.places, n, m);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    const bits = new Uint32Array(4 * n * m);
    gl.readPixels(0, 0, n, m, gl.RGBA_INTEGER, gl.UNSIGNED_INT, bits);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    return new Float32Array(bits.buffer);
  };
  const largest = (four) => four.reduce((most, x, i) => (i % 4 === 2 && !(Math.abs(x) <= most || Number.isNaN(most)) ? Math.abs(x) : most), 0);
  // Places of mu in [0, 1], and the domain of a certificate.
  const place = (mu) => {
    const [from, to] = lobe().truth.mu;
    return Math.sqrt(Math.min(Math.max((mu - from) / (to - from || 1), 0), 1));
  };
  const domain = ({ certificate }) => ({ ...lobe().truth, ...(certificate && certificate.domain) });
  const anywhere = (approximation) => {
    const { roughness, mu } = domain(approximation);
    return largest(measured(approximation, [...roughness, ...mu.map(place)], [GRID, GRID]));
  };
  const here = (approximation) => largest(measured(approximation, [state.roughness, state.roughness, ...domain(approximation).mu.map(place)], [1, GRID]));

  const draw = () => {
    const side = Math.max(Math.round((canvas.clientWidth * (window.devicePixelRatio || 1)) / 3), 16);
    if (canvas.width !== 3 * side) [canvas.width, canvas.height] = [3 * side, 2 * side];
    gl.clearColor(0, 0, 0, 0);
    gl.disable(gl.SCISSOR_TEST);
    gl.clear(gl.COLOR_BUFFER_BIT);
    const [a, b] = [chosen("a"), chosen("b")];
    const cells = [[a, 0, 0, 0, 1], [b, 0, 0, 1, 1], [b, 1, 0, 2, 1], [a, 0, 1, 0, 0], [b, 0, 1, 1, 0], [b, 0, 2, 2, 0]];
    for (const [approximation, column, picture, x, y] of cells) {
      if (!approximation) continue;
      const places = using(approximation, "draw");
      gl.viewport(x * side, y * side, side, side);
      gl.uniform3f(places.cell, x * side, y * side, side);
      gl.uniform1i(places.column, column);
      gl.uniform1i(places.picture, picture);
      gl.uniform1f(places.rough, state.roughness);
      gl.uniform1f(places.limit, 1 / state.times);
      gl.uniform1i(places.in_furnace, state.under === "furnace");
      gl.uniform3f(places.light, ...light);
      gl.drawArrays(gl.TRIANGLES, 0, 3);
    }
  };

  const TITLES = { without: "Without", emitted: "In the include files", table: "Tables", frontier: "Not emitted: of the frontier", published: "Published" };
  const options = (select) => {
    select.replaceChildren();
    for (const [standing, label] of Object.entries(TITLES)) {
      const all = offered().filter((one) => one.standing === standing);
      if (all.length === 0) continue;
      const group = select.appendChild(document.createElement("optgroup"));
      group.label = label;
      for (const { name, cost, certificate } of all) {
        make("option", certificate ? `${name}: ${cost.ops} ops` : name, group).value = name;
      }
    }
  };
  const row = (body, label, one) => {
    const { cost, certificate: c } = one;
    const line = body.insertRow();
    const certified = c ? [figure(c.max_abs), figure(c.rms)] : ["", ""];
    const cells = [label, one.source && one.source !== "fitted" ? `${one.name} (${one.source})` : one.name];
    cells.push(...certified, ...(c ? [cost.ops, cost.fetches, cost.bytes, data.times.microseconds[one.name] || ""] : ["", "", "", ""]), figure(anywhere(one)), figure(here(one)));
    cells.push(c ? Object.entries(c.at).map(([name, value]) => `${name} ${figure(value)}`).join(", ") : "");
    cells.forEach((text, i) => {
      make("td", text, line).className = i > 1 && i < 10 ? "n" : "";
    });
  };
  // What a certificate says nothing of.
  const outside = (one) => {
    const { f0, roughness } = domain(one);
    const beyond = (values, [low, high]) => values.some((x) => x < low - 1e-6 || x > high + 1e-6);
    const about = (name, values, range) => (range && beyond(values, range) ? [` The certificate of ${one.name} is for ${name} in [${range.map(figure).join(", ")}].`] : []);
    return [...about("f0", state.f0, f0), ...about("roughness", [state.roughness], roughness)];
  };
  const words = () => {
    const { lead, truth, drawn } = lobe();
    const [a, b] = [chosen("a"), chosen("b")];
    document.getElementById("lead").textContent = lead;
    const [above, below] = ["above", "below"].map((id) => [...document.getElementById(id).children]);
    const vanishes = state.under === "furnace" && (drawn.base || (drawn === "compensation" && state.f0.every((x) => x === 1)));
    // a name may break after its underscores
    const parts = (name) => name.split(/(?<=_)/).flatMap((part) => [document.createElement("wbr"), part]);
    [a, b].forEach((one, i) => above[i].replaceChildren(...parts(one.name)));
    above[2].textContent = vanishes ? "truth: cannot be seen" : "truth";
    [a, b].forEach((one, i) => (below[i].textContent = `error \u00d7${state.times}, ${figure(here(one))} at most`));
    below[2].textContent = "error of the middle over roughness (right) and mu (up)";
    const ends = root.querySelectorAll(".key span");
    const [less, more] = drawn === "value" ? ["too low", "too high"] : ["light is lost", "light is gained"];
    ends[0].textContent = `\u2212${1 / state.times}: ${less}`;
    ends[2].textContent = `+${1 / state.times}: ${more}`;
    const body = document.querySelector("#costs tbody");
    body.replaceChildren();
    row(body, "left", a);
    row(body, "middle", b);
    const about = drawn === "compensation" ? ": |E N \u2212 1| of a formula, the lookup error of E of a table" : "";
    document.getElementById("stated").textContent =
      `Max error and RMS are the certificate${about}. Largest drawn is what this page finds at ${GRID}\u00d7${GRID} places of its domain${drawn === "value" ? "" : ", for this f0"}. ` +
      `The truth is interpolated between ${truth.size.join("\u00d7")} texels: off by ${figure(truth.error)} at most.` +
      (Object.keys(data.times.microseconds).length ? ` Times are of one call for each pixel of 3840\u00d72160 on an ${data.times.device}, where recorded.` : "") +
      [...new Set([...outside(a), ...outside(b)])].join("");
    document.querySelector("#code code").textContent = b.text || b.call;
  };
  const metals = document.getElementById("metals");
  for (const [name, f0] of Object.entries(METALS)) {
    const button = make("button", name, metals);
    button.type = "button";
    button.addEventListener("click", () => set({ f0 }));
  }
  const show = () => {
    const { truth, drawn } = lobe();
    for (const side of ["a", "b"]) {
      options(control(side));
      control(side).value = state[side];
    }
    control("lobe").value = state.lobe;
    const [slide, reflectance] = [control("roughness"), control("f0")];
    [slide.min, slide.max] = truth.roughness;
    slide.value = state.roughness;
    slide.nextElementSibling.value = state.roughness.toFixed(3);
    reflectance.value = state.f0[0];
    reflectance.nextElementSibling.value = new Set(state.f0).size === 1 ? state.f0[0].toFixed(3) : state.f0.join(", ");
    reflectance.closest("label").hidden = drawn === "value";
    metals.parentElement.hidden = drawn !== "compensation";
    [...metals.querySelectorAll("button")].forEach((button) => button.setAttribute("aria-pressed", String(METALS[button.textContent].join() === state.f0.join())));
    for (const name of ["under", "times"]) root.querySelectorAll(`[name=${name}]`).forEach((one) => (one.checked = one.value === String(state[name])));
    words();
    draw();
  };
  let asked = false;
  const set = (change) => {
    Object.assign(state, change);
    settle();
    history.replaceState(null, "", address());
    if (asked) return;
    asked = true;
    requestAnimationFrame(() => {
      asked = false;
      show();
    });
  };

  lobes.forEach(({ name, title }) => (make("option", title, control("lobe")).value = name));
  control("lobe").addEventListener("change", (event) => set({ lobe: event.target.value, a: "", b: "", f0: Array(3).fill(find(lobes, event.target.value).f0) }));
  for (const side of ["a", "b"]) control(side).addEventListener("change", (event) => set({ [side]: event.target.value }));
  control("roughness").addEventListener("input", (event) => set({ roughness: Number(event.target.value) }));
  control("f0").addEventListener("input", (event) => set({ f0: Array(3).fill(Number(event.target.value)) }));
  root.querySelectorAll("[name=under]").forEach((one) => one.addEventListener("change", () => set({ under: one.value })));
  root.querySelectorAll("[name=times]").forEach((one) => one.addEventListener("change", () => set({ times: Number(one.value) })));
  addEventListener("hashchange", () => {
    take(location.hash.slice(1));
    set({});
  });
  addEventListener("resize", () => set({}));

  const next = (list, now, step) => list[(list.indexOf(now) + step + list.length) % list.length];
  const KEYS = {
    ArrowLeft: (event) => ({ roughness: state.roughness - (event.shiftKey ? 0.1 : 0.01) }),
    ArrowRight: (event) => ({ roughness: state.roughness + (event.shiftKey ? 0.1 : 0.01) }),
    ArrowUp: () => ({ b: next(offered(), chosen("b"), -1).name }),
    ArrowDown: () => ({ b: next(offered(), chosen("b"), 1).name }),
    l: () => ({ under: state.under === "light" ? "furnace" : "light" }),
    x: () => ({ times: next([10, 50, 100], state.times, 1) }),
  };
  addEventListener("keydown", (event) => {
    const key = KEYS[event.key] || KEYS[event.key.toLowerCase()];
    if (!key || event.ctrlKey || event.metaKey || event.altKey || /^(SELECT|INPUT|SUMMARY|BUTTON|TH)$/.test(event.target.tagName)) return;
    event.preventDefault();
    set(key(event));
  });

  // What lies under the pointer: cell, roughness and mu; none beside the spheres.
  const under = (event) => {
    const box = canvas.getBoundingClientRect();
    const [x, y] = [(3 * (event.clientX - box.left)) / box.width, (2 * (event.clientY - box.top)) / box.height];
    const [column, line] = [Math.min(Math.max(Math.floor(x), 0), 2), Math.min(Math.max(Math.floor(y), 0), 1)];
    const [u, v] = [x - column, 1 - (y - line)];
    const { truth: { roughness: [low, high], mu: [from, to] } } = lobe();
    if (column === 2 && line === 1) return { roughness: low + (high - low) * u, mu: from + (to - from) * v * v };
    const at = [(u - 0.5) / 0.44, (v - 0.5) / 0.44];
    const r2 = at[0] * at[0] + at[1] * at[1];
    return r2 < 1 ? { roughness: state.roughness, mu: Math.min(Math.max(Math.sqrt(1 - r2), from), to), at } : null;
  };
  canvas.addEventListener("pointermove", (event) => {
    const spot = under(event);
    if (!spot) return;
    if (event.buttons && spot.at) {
      [light[0], light[1], light[2]] = [spot.at[0], spot.at[1], Math.sqrt(1 - spot.at[0] ** 2 - spot.at[1] ** 2)];
      set({ under: "light" });
    }
    const y = place(spot.mu);
    const point = (side) => measured(chosen(side), [spot.roughness, spot.roughness, y, y], [1, 1]);
    const [left, middle] = [point("a"), point("b")];
    document.getElementById("under-pointer").textContent =
      `mu ${figure(spot.mu)}, roughness ${figure(spot.roughness)}: truth ${figure(middle[1])}; left ${figure(left[0])}, error ${signed(left[2])}; ` +
      `middle ${figure(middle[0])}, error ${signed(middle[2])}`;
    draw();
  });
  canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));

  const ramp = document.getElementById("ramp").getContext("2d");
  bytes(data.ramp).forEach((_, i, all) => {
    if (i % 3) return;
    ramp.fillStyle = `rgb(${all[i]}, ${all[i + 1]}, ${all[i + 2]})`;
    ramp.fillRect(i / 3, 0, 1, 1);
  });
  state.f0 = Array(3).fill(lobes[0].f0);
  take(location.hash.slice(1));
  settle();
  show();
  // For scripts and tests.
  window.explore = {
    lobes, offered, state, gl, canvas, draw, anywhere, here,
    measured: (side, roughness, y) => [...measured(chosen(side), [roughness, roughness, y, y], [1, 1])],
    set: (change) => {
      Object.assign(state, change);
      settle();
      show();
    },
  };
})();
