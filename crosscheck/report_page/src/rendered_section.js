// The rendered frame as each side draws its own particles.
import { h, section } from "./dom.js";
import { grouped } from "./numbers.js";

export function renderedSection({ rendered }) {
  if (!rendered) return null;
  const figure = ({ title, png }) =>
    h("figure", {}, h("figcaption", {}, title), h("img", { class: "rendered", src: `data:image/png;base64,${png}`, alt: `${title}: rendered frame ${rendered.frame}` }));
  return section(
    "rendered",
    "The rendered frame",
    h("p", { class: "muted" }, `What a viewer sees in frame ${grouped(rendered.frame)}, each side's own particles. In the difference, pixels that differ are red; the others are the reference, dimmed.`),
    h("div", { class: "pictures" }, rendered.pictures.map(figure)),
  );
}
