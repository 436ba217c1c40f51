// Numbers as `scarp measure` prints them.

/** Prints six digits. */
export function number(value) {
  return Number.isFinite(value) ? String(Number(value.toPrecision(6))) : 'none';
}

export function count(value) {
  return value.toLocaleString('en');
}

export function share(part, whole) {
  return `${Number(((100 * part) / whole).toPrecision(3))} %`;
}

export function bytes(value) {
  const unit = value >= 1e6 ? ['MB', 1e6] : value >= 1e3 ? ['kB', 1e3] : ['bytes', 1];
  return `${Number((value / unit[1]).toPrecision(3))} ${unit[0]}`;
}

export function withUnit(value, unit) {
  return unit ? `${number(value)} ${unit}` : number(value);
}

/** A length in metres, or in the mesh's units if metres are unknown. */
export function distance(value, unit = 'm') {
  return unit === 'm' && value >= 1000
    ? `${Number((value / 1000).toPrecision(4))} km`
    : `${Number(value.toPrecision(4))} ${unit}`;
}
