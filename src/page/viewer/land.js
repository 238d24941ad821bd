// Brings what a link names to the top of the window, below the menu: opens what it is folded into, and stays with it while what stands
// above is still being drawn.
let ended = () => {};

// Opens every fold around `element`, and the one that it is the head of.
export function unfold(element) {
  for (let at = element; at; at = at.parentElement) if (at.tagName === "DETAILS") at.open = true;
  const own = element.querySelector(":scope > details");
  if (own) own.open = true;
}

export function land(element) {
  ended();
  unfold(element);
  const put = () => element.scrollIntoView({ block: "start" });
  put();
  const moved = new ResizeObserver(put);
  moved.observe(document.querySelector("main"));
  const hands = ["wheel", "touchstart", "keydown", "pointerdown"];
  ended = () => {
    moved.disconnect();
    hands.forEach((hand) => removeEventListener(hand, ended));
  };
  hands.forEach((hand) => addEventListener(hand, ended, { passive: true }));
}
