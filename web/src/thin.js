// Thinning for drawing: of each stretch of the abscissa, the least and the greatest value of every line stay. What is saved is
// never thinned.

/** First index with x[index] >= value, for increasing x. */
export function lowerBound(x, value) {
  let low = 0;
  let high = x.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (x[middle] < value) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** Lines over a common abscissa between `from` and `to`, with at most two points in each of `buckets` stretches.
 *  @param x increasing abscissa
 *  @param lines arrays as long as x
 *  @return {x, lines}: plain arrays; null where a value is not finite. Points just outside the range stay, so that lines
 *  reach its edges. A range with few points is not thinned at all. */
export function thin(x, lines, from, to, buckets) {
  const first = Math.max(0, lowerBound(x, from) - 1);
  const last = Math.min(x.length, lowerBound(x, to) + 2);
  const count = last - first;
  if (count <= 2 * buckets) {
    return {
      x: Array.from(x.subarray(first, last)),
      lines: lines.map((y) =>
        Array.from(y.subarray(first, last), (value) => (Number.isFinite(value) ? value : null)),
      ),
    };
  }
  const thinned = { x: new Array(2 * buckets), lines: lines.map(() => new Array(2 * buckets)) };
  for (let bucket = 0; bucket < buckets; bucket++) {
    const begin = first + Math.floor((bucket * count) / buckets);
    const end = first + Math.floor(((bucket + 1) * count) / buckets);
    thinned.x[2 * bucket] = x[begin];
    thinned.x[2 * bucket + 1] = x[end - 1];
    lines.forEach((y, line) => {
      let least = begin;
      let greatest = begin;
      for (let index = begin + 1; index < end; index++) {
        if (!(y[index] >= y[least])) least = Number.isFinite(y[index]) ? index : least;
        if (!(y[index] <= y[greatest])) greatest = Number.isFinite(y[index]) ? index : greatest;
      }
      const [early, late] = least < greatest ? [least, greatest] : [greatest, least];
      thinned.lines[line][2 * bucket] = Number.isFinite(y[early]) ? y[early] : null;
      thinned.lines[line][2 * bucket + 1] = Number.isFinite(y[late]) ? y[late] : null;
    });
  }
  return thinned;
}
