// Finds skills, tasks and terms by any part of their names.
"use strict";
const entries = [/* entries */];
const form = document.getElementById("search");
const query = document.getElementById("query");
const results = document.getElementById("results");
const root = document.documentElement.dataset.root;

function rank(name, words) {
  const bare = name.slice(name.indexOf(":") + 1);
  return bare === words ? 0 : bare.startsWith(words) ? 1 : 2;
}

function found(words) {
  return entries
    .map((entry) => [entry, entry[0].toLowerCase()])
    .filter(([, name]) => name.includes(words))
    .sort(([, one], [, other]) => rank(one, words) - rank(other, words))
    .slice(0, 12)
    .map(([entry]) => entry);
}

function show() {
  const words = query.value.trim().toLowerCase();
  results.replaceChildren();
  if (!words) return;
  for (const [name, kind, page] of found(words)) {
    const link = document.createElement("a");
    link.href = root + page;
    link.textContent = name;
    const item = document.createElement("li");
    item.append(link, ` ${kind}`);
    results.append(item);
  }
  if (!results.children.length) results.append(Object.assign(document.createElement("li"), { textContent: "nothing" }));
}

form.hidden = false;
query.addEventListener("input", show);
form.addEventListener("submit", (event) => {
  event.preventDefault();
  const first = results.querySelector("a");
  if (first) location.href = first.href;
});
document.addEventListener("keydown", (event) => {
  if (event.key === "Escape") {
    query.value = "";
    show();
  }
});
