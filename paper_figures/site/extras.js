// Extras: no page needs them to be read. Pictures open in a dialog, and the list of claims has a filter.
"use strict";

const enlarge = () => {
  const dialog = document.createElement("dialog");
  dialog.className = "large";
  dialog.setAttribute("aria-label", "Picture, enlarged");
  document.body.append(dialog);
  dialog.addEventListener("click", () => dialog.close());
  for (const link of document.querySelectorAll("a.zoom")) {
    link.addEventListener("click", (event) => {
      event.preventDefault();
      const picture = link.querySelector("img").cloneNode();
      picture.loading = "eager";
      const close = document.createElement("button");
      close.textContent = "Close";
      dialog.replaceChildren(close, picture);
      dialog.showModal();
    });
  }
};

const filter = (form) => {
  const rows = [...document.querySelectorAll("tr.claim")];
  const texts = rows.map((row) => row.textContent.toLowerCase());
  form.hidden = false;
  form.addEventListener("submit", (event) => event.preventDefault());
  form.addEventListener("input", () => {
    const words = form.words.value.toLowerCase().split(/\s+/);
    let found = 0;
    document.getElementById("all-settings").open = true;
    rows.forEach((row, number) => {
      const fits = words.every((word) => texts[number].includes(word)) &&
        (!form.figure.value || row.dataset.figure === form.figure.value);
      row.hidden = !fits;
      found += fits;
    });
    form.found.value = `${found} of ${rows.length} claims`;
  });
};

enlarge();
const form = document.getElementById("filter");
if (form) filter(form);
