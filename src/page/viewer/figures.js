// Figures stand in the page packed; each becomes a picture when it comes near the screen, and all before printing.
export function figures(packed, unpack) {
  const byName = new Map(packed.map((element) => [element.dataset.name, element]));
  const draw = async (image) => {
    const element = byName.get(image.dataset.figure);
    if (!element) {
      image.replaceWith(Object.assign(document.createElement("p"), { className: "note", textContent: "not drawn" }));
      return;
    }
    image.src = URL.createObjectURL(new Blob([await unpack(element)], { type: "image/svg+xml" }));
    delete image.dataset.figure;
  };
  const seen = new IntersectionObserver(
    (entries) => entries.filter((entry) => entry.isIntersecting).forEach((entry) => {
      seen.unobserve(entry.target);
      draw(entry.target);
    }),
    { rootMargin: "800px" },
  );
  document.querySelectorAll("img[data-figure]").forEach((image) => seen.observe(image));
  addEventListener("beforeprint", () => document.querySelectorAll("img[data-figure]").forEach(draw));
}
