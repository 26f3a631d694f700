
"use strict";
// Sorts the table of verdicts, filters it and that of suites, and unfolds what a link leads to. Without it everything is read.
(() => {
  const section = document.getElementById("verdicts");
  const table = section.querySelector("table");
  const body = table.tBodies[0];
  const rows = Array.from(body.rows);
  const heads = Array.from(table.tHead.rows[0].cells);

  const number = (row, k) => {
    const value = row.cells[k].dataset.value;
    return value === undefined ? null : Number(value);
  };
  const compare = (a, b, k, down) => {
    let order;
    if (heads[k].classList.contains("number")) {
      const [x, y] = [number(a, k), number(b, k)];
      if (x === null || y === null) return (x === null) - (y === null);
      order = x < y ? -1 : x > y ? 1 : 0;
    } else {
      const [x, y] = [a.cells[k].textContent, b.cells[k].textContent];
      order = x < y ? -1 : x > y ? 1 : 0;
    }
    return down ? -order : order;
  };
  heads.forEach((head, k) => {
    const button = document.createElement("button");
    button.type = "button";
    button.append(...head.childNodes);
    head.append(button);
    button.addEventListener("click", () => {
      const down = head.getAttribute("aria-sort") === "ascending";
      heads.forEach((other) => other.removeAttribute("aria-sort"));
      head.setAttribute("aria-sort", down ? "descending" : "ascending");
      body.append(...rows.slice().sort((a, b) => compare(a, b, k, down)));
    });
  });

  const filter = (table, rows) => {
    const label = document.createElement("label");
    const input = document.createElement("input");
    const count = document.createElement("output");
    label.className = "filter";
    input.type = "search";
    label.append("Show only rows with ", input, count);
    table.parentElement.before(label);
    input.addEventListener("input", () => {
      const words = input.value.toLowerCase().split(/\s+/).filter(Boolean);
      let shown = 0;
      for (const row of rows) {
        const text = row.textContent.toLowerCase();
        row.hidden = !words.every((word) => text.includes(word));
        shown += row.hidden ? 0 : 1;
      }
      count.textContent = words.length ? `${shown} of ${rows.length}` : "";
    });
  };
  filter(table, rows);
  const suites = document.querySelector("#suites table");
  filter(suites, Array.from(suites.querySelectorAll("tbody tr:not(.group)")));

  const unfold = () => {
    const target = document.getElementById(location.hash.slice(1));
    if (!target) return;
    for (let at = target; at; at = at.parentElement) {
      if (at.tagName === "DETAILS") at.open = true;
    }
    target.scrollIntoView();
  };
  addEventListener("hashchange", unfold);
  unfold();
})();
