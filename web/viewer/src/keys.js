// The effects of keys.
const TURNED = 5; // degrees
const MOVED = 0.1; // share of the picture's height

export function listenToKeys(page) {
  addEventListener('keydown', event => {
    const { target, key } = event;
    const isControl = target.matches?.('input, select, button, dialog, [role=slider]');
    if (event.ctrlKey || event.metaKey || event.altKey || !page.document || document.querySelector('dialog[open]'))
      return;
    if (isControl && /^(Arrow|Enter|Page| )/.test(key)) return;
    const arrow = (x, y) =>
      event.shiftKey ? page.scene.move(x * MOVED, y * MOVED) : page.scene.turn(-x * TURNED, y * TURNED);
    const action = {
      w: () => page.change({ edges: !page.look.edges }),
      e: () => page.document.field && page.change({ errors: !page.look.errors }),
      i: () => page.hasImage && page.change({ image: page.look.errors || !page.look.image, errors: false }),
      n: () => page.change({ smooth: !page.look.smooth }),
      s: () => page.live.toggleBoth(),
      m: () => page.measuring.turn(!page.measuring.isOn),
      r: () => page.reset(),
      '?': () => document.getElementById('help').click(),
      '+': () => page.live.step(1),
      '=': () => page.live.step(1),
      '-': () => page.live.step(-1),
      ArrowLeft: () => arrow(-1, 0),
      ArrowRight: () => arrow(1, 0),
      ArrowUp: () => arrow(0, 1),
      ArrowDown: () => arrow(0, -1),
      PageUp: () => page.scene.approach(0.8),
      PageDown: () => page.scene.approach(1.25),
      Enter: () => page.measuring.isOn && page.measuring.click(innerWidth / 2, innerHeight / 2, page),
      Escape: () => page.measuring.turn(false),
    }[key.length === 1 ? key.toLowerCase() : key];
    if (!action) return;
    event.preventDefault();
    action();
  });
}
