// h("p", {class: "note"}, "text", child...): an element. Properties that are functions are listeners.
export function h(name, properties = {}, ...children) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(properties)) {
    if (value === null || value === undefined || value === false) continue;
    if (typeof value === "function") element.addEventListener(key, value);
    else element.setAttribute(key, value === true ? "" : value);
  }
  element.append(...children.flat().filter((child) => child !== null && child !== undefined && child !== ""));
  return element;
}

// A part of the page, named by its heading.
export function section(id, title, ...children) {
  return h("section", { id, "aria-labelledby": `${id}-title` }, h("h2", { id: `${id}-title` }, title), ...children);
}

export function commandLine(command) {
  const said = h("span", { class: "copied", role: "status" });
  const code = h("code", {}, command);
  const copy = async () => {
    try {
      await navigator.clipboard.writeText(command);
      said.textContent = "copied";
    } catch {
      getSelection().selectAllChildren(code);
      said.textContent = "selected";
    }
    setTimeout(() => (said.textContent = ""), 2000);
  };
  return h(
    "div",
    { class: "command" },
    h("pre", { tabindex: "0", "aria-label": "command line" }, code),
    h("button", { type: "button", class: "quiet", click: copy, "aria-label": `Copy: ${command}` }, "Copy"),
    said,
  );
}

// A table that scrolls by itself where the window is narrow.
export function scrolling(label, table) {
  return h("div", { class: "scrolling", tabindex: "0", role: "region", "aria-label": label }, table);
}
