// Columns as `gough report` packs them (src/cli/report/packed.c): bytes of the differences between the bits of each number and of
// its extrapolation from those before.
import { bytesOf } from "./core.js";

/** The weights of the polynomial through the last `order` numbers, one row further. */
function weightsOf(order) {
  const weights = [];
  let weight = -1;
  for (let j = 1; j <= order; j++) {
    weight = (-weight * (order - j + 1)) / j;
    weights.push(weight);
  }
  return weights;
}

/** The extrapolation of a row, added in the order of the command; 0 where it is not finite. */
function extrapolated(values, row, weights) {
  let sum = 0;
  for (let j = 1; j <= weights.length; j++) sum += weights[j - 1] * values[row - j];
  return Number.isFinite(sum) ? sum : 0;
}

/** The numbers of a column {rows, order, packed}. @param inflate zlib's decompression. */
export function unpacked({ rows, order, packed }, inflate) {
  const bytes = inflate(bytesOf(packed));
  const values = new Float64Array(rows);
  const guess = new DataView(new ArrayBuffer(8));
  const half = (row, first) =>
    (bytes[first * rows + row] |
      (bytes[(first + 1) * rows + row] << 8) |
      (bytes[(first + 2) * rows + row] << 16) |
      (bytes[(first + 3) * rows + row] << 24)) >>>
    0;
  const weights = Array.from({ length: order + 1 }, (_, known) => weightsOf(known));
  for (let row = 0; row < rows; row++) {
    const [low, high] = [half(row, 0), half(row, 4)];
    // 0, 1, 2, 3 … stand for 0, −1, 1, −2 …: halved, and all bits turned over if it was odd
    const sign = -(low & 1);
    const differenceLow = (((low >>> 1) | (high << 31)) ^ sign) >>> 0;
    const differenceHigh = ((high >>> 1) ^ sign) >>> 0;
    guess.setFloat64(0, extrapolated(values, row, weights[Math.min(row, order)]));
    const sum = guess.getUint32(4) + differenceLow;
    guess.setUint32(4, sum >>> 0);
    guess.setUint32(0, (guess.getUint32(0) + differenceHigh + (sum > 0xffffffff ? 1 : 0)) >>> 0);
    values[row] = guess.getFloat64(0);
  }
  return values;
}
