"use strict";
// Marks the page in the bar.
document.querySelectorAll("nav.bar a").forEach((a) => {
  if (a.pathname === location.pathname) a.setAttribute("aria-current", "page");
});
// Numbers as pages write them: a minus and an exponent of their own characters, a unit after them.
const number = (text) => parseFloat(text.replace(/\u2212/g, "-").replace(/[\u00a0\u202f,]/g, ""));
const written = (x) => {
  const size = Math.abs(x);
  const short = () => (size < 1e-3 || size >= 1e5 ? x.toExponential(2) : x.toPrecision(3));
  const text = Number.isInteger(x) ? String(x) : short();
  return text.replace(/-/g, "\u2212");
};
const sortable = (table) => {
  const body = table.tBodies[0];
  const rows = [...body.rows];
  if (rows.length < 3) return;
  const heads = [...table.tHead.rows[0].cells];
  const sort = (column) => {
    const head = heads[column];
    const down = head.getAttribute("aria-sort") === "ascending";
    heads.forEach((other) => other.removeAttribute("aria-sort"));
    head.setAttribute("aria-sort", down ? "descending" : "ascending");
    const figures = head.classList.contains("n");
    const text = (row) => row.cells[column].textContent.trim();
    const value = figures ? (row) => number(text(row)) : text;
    const nothing = figures ? Number.isNaN : (x) => x === "" || x === "\u2013";
    const order = figures ? (x, y) => x - y || 0 : (x, y) => x.localeCompare(y, undefined, { numeric: true });
    // Cells without a value are last, whatever the direction.
    const before = (a, b) => {
      const [x, y] = [value(a), value(b)];
      return nothing(x) - nothing(y) || (nothing(x) ? 0 : down ? order(y, x) : order(x, y));
    };
    [...rows].sort(before).forEach((row) => body.append(row));
  };
  heads.forEach((head, column) => {
    head.classList.add("sorts");
    head.tabIndex = 0;
    head.addEventListener("click", () => sort(column));
    head.addEventListener("keydown", (event) => {
      if (event.key === "Enter") sort(column);
    });
  });
  if (rows.length < 8) return;
  // By words; by whose they are, where some are set back in grey; by the most operations.
  const filters = document.createElement("div");
  filters.className = "filters";
  const control = (kind, label, more) => {
    const made = Object.assign(document.createElement(kind), more);
    made.setAttribute("aria-label", label);
    filters.append(made);
    return made;
  };
  const filter = control("input", "filter rows", { placeholder: "filter rows" });
  const theirs = rows.filter((row) => row.classList.contains("muted")).length;
  const whose = theirs > 0 && theirs < rows.length && control("select", "whose");
  if (whose) ["ours and published", "ours", "published"].forEach((text) => whose.add(new Option(text)));
  const ops = heads.findIndex((head) => head.textContent === "ops");
  const most = ops >= 0 && control("input", "most operations", { type: "number", min: 0, placeholder: "at most … operations" });
  filters.addEventListener("input", () => {
    const words = filter.value.toLowerCase().split(/\s+/);
    const limit = most && most.value !== "" ? Number(most.value) : Infinity;
    const side = whose ? whose.selectedIndex : 0;
    rows.forEach((row) => {
      const text = row.textContent.toLowerCase();
      const muted = row.classList.contains("muted");
      const kept = side === 0 || muted === (side === 2);
      row.hidden = !kept || !words.every((word) => text.includes(word)) || (ops >= 0 && number(row.cells[ops].textContent) > limit);
    });
  });
  table.parentElement.before(filters);
};
const copyable = (pre) => {
  if (!navigator.clipboard) return;
  const code = pre.firstElementChild || pre;
  const button = document.createElement("button");
  button.textContent = pre.dataset.language ? `copy ${pre.dataset.language}` : "copy";
  button.addEventListener("click", async () => {
    await navigator.clipboard.writeText(code.textContent);
    button.textContent = "copied";
  });
  pre.append(button);
};
// A link may lead into what is folded.
const reveal = () => {
  const target = location.hash.length > 1 && document.getElementById(location.hash.slice(1));
  if (!target) return;
  for (let fold = target.closest("details"); fold; fold = fold.parentElement.closest("details")) fold.open = true;
  target.scrollIntoView();
};
addEventListener("hashchange", reveal);
reveal();
// Values under the pointer.
const tip = document.createElement("div");
tip.className = "tip";
tip.hidden = true;
document.body.append(tip);
const show = (event, text) => {
  tip.hidden = !text;
  if (!text) return;
  tip.textContent = text;
  const left = Math.min(event.clientX + 14, innerWidth - tip.offsetWidth - 4);
  const above = event.clientY - tip.offsetHeight - 12;
  tip.style.left = `${Math.max(left, 4)}px`;
  tip.style.top = `${above > 4 ? above : event.clientY + 16}px`;
};
const root = (x) => Math.sign(x) * Math.sqrt(Math.abs(x));
const inverse = ([spread, min, max], t) => {
  if (spread === "log") return min * (max / min) ** t;
  if (spread !== "root") return min + (max - min) * t;
  const between = root(min) + (root(max) - root(min)) * t;
  return between * Math.abs(between);
};
// The value of a pixel is its colour's place in the colour bar, which is a picture of its own.
const reader = (svg, shade) => {
  const pixels = [...svg.querySelectorAll("image")].slice(0, 2).map((image) => {
    const picture = new Image();
    const found = {};
    picture.onload = () => {
      const canvas = document.createElement("canvas");
      [canvas.width, canvas.height] = [picture.naturalWidth, picture.naturalHeight];
      const context = canvas.getContext("2d");
      context.drawImage(picture, 0, 0);
      const { data, width, height } = context.getImageData(0, 0, canvas.width, canvas.height);
      Object.assign(found, { data, width, height });
    };
    picture.src = image.getAttribute("href");
    return found;
  });
  return (across, down) => {
    const [picture, bar] = pixels;
    if (!picture.data || !bar.data) return "";
    const column = Math.min(Math.floor(across * picture.width), picture.width - 1);
    const row = Math.min(Math.floor(down * picture.height), picture.height - 1);
    const at = 4 * (row * picture.width + column);
    let [best, nearest] = [0, Infinity];
    for (let i = 0; i < bar.height; i += 1) {
      const distance = [0, 1, 2].reduce((sum, c) => sum + (bar.data[4 * i + c] - picture.data[at + c]) ** 2, 0);
      if (distance < nearest) [best, nearest] = [i, distance];
    }
    const t = 1 - best / (bar.height - 1);
    const value = (place) => {
      const side = shade.signed ? 2 * place - 1 : place;
      return Math.sign(shade.signed ? side : 1) * inverse(shade.scale, Math.abs(side));
    };
    // Colours beyond an end are those of the end; between two colours nothing is known.
    const end = t === 1 ? "\u2265 " : t === 0 ? "\u2264 " : "";
    const step = 0.5 / (bar.height - 1);
    const off = Math.abs(value(Math.min(t + step, 1)) - value(Math.max(t - step, 0))) / 2;
    return `${end}${written(value(t))} \u00b1 ${off.toPrecision(1)}`;
  };
};
// What a plot says of a place in it, in pixels of the page: [across, down] in its frame, 0 to 1.
const said = {
  map: (data, read) => (across, down) => {
    const of = ([name, values], t) => `${name} ${written(values[Math.min(Math.floor(t * values.length), values.length - 1)])}`;
    const places = `${of(data.x, across)}, ${of(data.y, data.down ? down : 1 - down)}`;
    return `${places}: ${read(across, down)}`;
  },
  cells: (data, read) => (across, down) => {
    const [rows, columns] = [data.rows.length, data.columns.length];
    const [row, column] = [Math.floor(down * rows), Math.floor(across * columns)];
    const name = [data.rows[row], `${data.name} ${data.columns[column]}`.trim()].join("; ");
    if (data.kinds && data.kinds[row][column] !== "v") return name;
    const [x, y] = [across * columns - column - 0.5, down * rows - row - 0.5];
    const r = data.radius ? Math.hypot(x, y) / data.radius : 1;
    const mu = r < 1 ? `, \u03bc ${written(Math.sqrt(1 - r * r))}` : "";
    return `${name}${mu}: ${data.unit} ${read(across, down)}`;
  },
  lines: (data, _, svg) => (across, down) => {
    const [left, top, right, bottom] = data.frame.map((x) => 10 * x);
    const lines = [...svg.querySelectorAll("polyline")].filter((line) => /^(16|17|30)$/.test(line.getAttribute("stroke-width")));
    const inside = lines.map((line) => line.getAttribute("points").trim().split(/\s+/).map((p) => p.split(",").map(Number)));
    const own = inside.filter((points) => points[0][1] >= top - 1);
    const x = left + across * (right - left);
    let [name, y, nearest] = ["", top + down * (bottom - top), Infinity];
    own.forEach((points, i) => {
      const next = points.findIndex((p, k) => k > 0 && points[k - 1][0] <= x && x <= p[0]);
      if (next < 0) return;
      const [a, b] = [points[next - 1], points[next]];
      const here = a[1] + ((b[1] - a[1]) * (x - a[0])) / Math.max(b[0] - a[0], 1);
      const distance = Math.abs(here - (top + down * (bottom - top)));
      if (distance < nearest) [name, y, nearest] = [data.lines[i] || "", here, distance];
    });
    const place = `${data.x[0]} ${written(inverse(data.x.slice(1), across))}`;
    const value = written(inverse(data.y.slice(1), (bottom - y) / (bottom - top)));
    return `${name ? `${name}; ` : ""}${place}: ${value}`;
  },
};
const speak = (svg) => {
  svg.querySelectorAll("circle > title").forEach((title) => {
    title.parentElement.dataset.tip = title.textContent;
    title.remove();
  });
  const data = svg.dataset.hover ? JSON.parse(svg.dataset.hover) : null;
  let say = null;
  svg.addEventListener("pointermove", (event) => {
    const spot = event.target.closest("[data-tip]");
    if (spot) return show(event, spot.dataset.tip);
    if (!data) return show(event, "");
    say ||= said[data.kind](data, data.shade && reader(svg, data.shade), svg);
    const box = svg.getBoundingClientRect();
    const view = svg.viewBox.baseVal;
    const x = ((event.clientX - box.left) / box.width) * (view.width / 10);
    const y = ((event.clientY - box.top) / box.height) * (view.height / 10);
    const [left, top, right, bottom] = data.frame;
    const [across, down] = [(x - left) / (right - left), (y - top) / (bottom - top)];
    const within = across >= 0 && across < 1 && down >= 0 && down < 1;
    return show(event, within ? say(across, down) : "");
  });
  svg.addEventListener("pointerleave", (event) => show(event, ""));
};
// What a reader can do with a part of the page.
const ready = (part) => {
  part.querySelectorAll(".wide table").forEach(sortable);
  part.querySelectorAll("pre").forEach(copyable);
  part.querySelectorAll("svg.plot").forEach(speak);
};
ready(document);
// What is packed is unpacked when its part of a switch, or its fold, is first seen.
const unpack = () => {
  document.querySelectorAll("[data-packed]").forEach(async (box) => {
    if (!box.offsetParent) return;
    const bytes = Uint8Array.from(atob(box.dataset.packed), (c) => c.charCodeAt(0));
    box.removeAttribute("data-packed");
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
    box.innerHTML = await new Response(stream).text();
    ready(box);
  });
};
["change", "toggle"].forEach((event) => addEventListener(event, unpack, true));
