// Prints numbers as {fmt} does, for the module, which contains no such code.

/// toFixed() or toExponential(), but ties are rounded to even, as in C.
function rounded(size, method, places) {
  const [exact, power] = size[method](100).split('e');
  const end = exact.indexOf('.') + 1 + places;
  const kept = exact.slice(0, end).replace(/\.$/, '');
  const isEven = Number(kept.at(-1)) % 2 === 0;
  if (!isEven || !/^50*$/.test(exact.slice(end))) return size[method](places);
  return power === undefined ? kept : `${kept}e${power}`;
}

/// `digits` as in toExponential(), without trailing zeros, in the shorter of the two notations, like printf's %g.
function general(digits, upper) {
  const [mantissa, power] = digits.split('e');
  const exponent = Number(power);
  const figures = mantissa.replace('.', '').replace(/0*$/, '');
  if (figures === '') return '0';
  const count = figures.length;
  if (exponent < -4 || exponent >= upper)
    return withExponent(`${figures[0]}${count > 1 ? '.' : ''}${figures.slice(1)}e${power}`);
  if (exponent < 0) return `0.${'0'.repeat(-exponent - 1)}${figures}`;
  if (exponent >= count - 1) return `${figures}${'0'.repeat(exponent + 1 - count)}`;
  return `${figures.slice(0, exponent + 1)}.${figures.slice(exponent + 1)}`;
}

/// At least two digits, as in C.
const withExponent = text => text.replace(/e([+-])(\d)$/, 'e$10$2');

/// The fewest digits that read back as the float32.
function shortestFloat(size) {
  for (let count = 0; ; ++count) {
    const digits = rounded(size, 'toExponential', count);
    if (count === 8 || Math.fround(digits) === size) return digits;
  }
}

/// Style: 'e', 'f', 'g'. Precision -1: the fewest digits that read back as the number, or the float32.
export function printNumber(value, isFloat, style, precision) {
  if (Number.isNaN(value)) return 'nan';
  const sign = value < 0 || Object.is(value, -0) ? '-' : '';
  const size = Math.abs(value);
  if (size === Infinity) return `${sign}inf`;
  if (precision < 0) return sign + general(isFloat ? shortestFloat(size) : size.toExponential(), 16);
  if (style === 'e') return sign + withExponent(rounded(size, 'toExponential', precision));
  if (style === 'f')
    return (
      sign +
      (size < 1e21
        ? rounded(size, 'toFixed', precision)
        : BigInt(size) + (precision ? `.${'0'.repeat(precision)}` : ''))
    );
  return sign + general(rounded(size, 'toExponential', Math.max(precision, 1) - 1), Math.max(precision, 1));
}
