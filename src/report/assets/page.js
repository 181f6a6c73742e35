"use strict";
// Marks the page in the bar.
const here = location.pathname.split("/").pop();
document.querySelectorAll("nav.bar a").forEach((a) => {
  if (a.getAttribute("href") === here) a.setAttribute("aria-current", "page");
});
// Numbers as pages write them: a minus and an exponent of their own characters, a unit after them.
const number = (text) => parseFloat(text.replace(/\u2212/g, "-").replace(/[\u00a0\u202f,]/g, ""));
document.querySelectorAll(".wide table").forEach((table) => {
  const body = table.tBodies[0];
  const rows = [...body.rows];
  if (rows.length < 3) return;
  const heads = [...table.tHead.rows[0].cells];
  const sort = (column) => {
    const head = heads[column];
    const down = head.getAttribute("aria-sort") === "ascending";
    heads.forEach((other) => other.removeAttribute("aria-sort"));
    head.setAttribute("aria-sort", down ? "descending" : "ascending");
    const value = (row) => row.cells[column].textContent;
    const figures = head.classList.contains("n");
    const before = (a, b) => {
      if (!figures) return value(a).localeCompare(value(b));
      const [x, y] = [number(value(a)), number(value(b))];
      return Number.isNaN(x) - Number.isNaN(y) || x - y || 0;
    };
    [...rows].sort((a, b) => (down ? -before(a, b) : before(a, b))).forEach((row) => body.append(row));
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
  const filter = document.createElement("input");
  filter.className = "filter";
  filter.placeholder = "filter rows";
  filter.setAttribute("aria-label", "filter rows");
  filter.addEventListener("input", () => {
    const words = filter.value.toLowerCase().split(/\s+/);
    rows.forEach((row) => {
      const text = row.textContent.toLowerCase();
      row.hidden = !words.every((word) => text.includes(word));
    });
  });
  table.parentElement.before(filter);
});
document.querySelectorAll("pre").forEach((pre) => {
  if (!navigator.clipboard) return;
  const text = pre.textContent;
  const button = document.createElement("button");
  button.textContent = "copy";
  button.addEventListener("click", async () => {
    await navigator.clipboard.writeText(text);
    button.textContent = "copied";
  });
  pre.append(button);
});
