// Light and dark: the system's choice, until the reader makes one. Paper is light whatever is chosen.
import { h } from "./dom.js";

const system = matchMedia("(prefers-color-scheme: dark)");
let chosen = null;

const isDark = () => (chosen ? chosen === "dark" : system.matches);

function apply(button) {
  document.documentElement.dataset.theme = isDark() ? "dark" : "light";
  button.textContent = isDark() ? "Light" : "Dark";
  document.dispatchEvent(new Event("themechange"));
}

export function themeButton() {
  const button = h("button", { type: "button", class: "quiet", id: "theme", title: "Change between light and dark" });
  button.addEventListener("click", () => {
    chosen = isDark() ? "light" : "dark";
    apply(button);
  });
  system.addEventListener("change", () => apply(button));
  matchMedia("print").addEventListener("change", () => document.dispatchEvent(new Event("themechange")));
  apply(button);
  return button;
}
