
"use strict";
// Sorts the table of verdicts, filters it and the table of suites, and unfolds the target of a link. On a narrow screen it
// hides all columns after the first two until a button is pressed. The page is complete without this script.
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

  // Filters by text and by the data attributes `keys`. They are part of the address, behind the id of the
  // table: `#verdicts&basis=linear&verdict=at+floor`.
  const filter = (id, table, rows, keys) => {
    const form = document.createElement("div");
    const count = document.createElement("output");
    form.className = "filter";
    const fields = ["text", ...keys].map((key) => {
      const label = document.createElement("label");
      const field = document.createElement(key === "text" ? "input" : "select");
      if (key === "text") {
        field.type = "search";
        label.append("Show only rows with ", field);
      } else {
        const values = [...new Set(rows.map((row) => row.dataset[key]))].sort();
        field.append(new Option("any", ""), ...values.map((value) => new Option(value, value)));
        label.append(`${key} `, field);
      }
      form.append(label);
      return [key, field];
    });
    form.append(count);
    table.parentElement.before(form);
    const apply = () => {
      const chosen = fields.map(([key, field]) => [key, field.value]).filter(([, value]) => value);
      const fits = (row) => chosen.every(([key, value]) => {
        if (key !== "text") return row.dataset[key] === value;
        const text = row.textContent.toLowerCase();
        return value.toLowerCase().split(/\s+/).filter(Boolean).every((word) => text.includes(word));
      });
      let shown = 0;
      for (const row of rows) {
        row.hidden = !fits(row);
        shown += row.hidden ? 0 : 1;
      }
      count.textContent = chosen.length ? `${shown} of ${rows.length}` : "";
      return chosen;
    };
    for (const [, field] of fields) {
      field.addEventListener("input", () => {
        const query = new URLSearchParams(apply()).toString();
        history.replaceState(null, "", query ? `#${id}&${query}` : `#${id}`);
      });
    }
    return (query) => {
      for (const [key, field] of fields) field.value = query.get(key) ?? "";
      apply();
    };
  };
  const suites = document.querySelector("#suites table");
  const filters = {
    verdicts: filter("verdicts", table, rows, ["basis", "transfer", "verdict"]),
    suites: filter("suites", suites, Array.from(suites.querySelectorAll("tbody tr:not(.group)")), []),
  };

  for (const table of document.querySelectorAll(".wide > table")) {
    const button = document.createElement("button");
    button.type = "button";
    button.className = "more";
    const set = (brief) => {
      table.parentElement.classList.toggle("brief", brief);
      button.textContent = brief ? "Show all columns" : "Show two columns";
      button.setAttribute("aria-expanded", String(!brief));
    };
    set(true);
    button.addEventListener("click", () => set(button.getAttribute("aria-expanded") === "true"));
    table.parentElement.before(button);
  }

  const unfold = () => {
    const [id, ...query] = location.hash.slice(1).split("&");
    if (query.length && filters[id]) filters[id](new URLSearchParams(query.join("&")));
    const target = document.getElementById(id);
    if (!target) return;
    for (let at = target; at; at = at.parentElement) {
      if (at.tagName === "DETAILS") at.open = true;
    }
    target.scrollIntoView();
  };
  addEventListener("hashchange", unfold);
  unfold();
})();
