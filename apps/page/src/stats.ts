// The intervals and fits of lib/base/statistics, for trials that a filter has chosen.
export interface Interval {
  lower: number;
  upper: number;
}

function logGamma(x: number): number {
  // Lanczos, g = 7, n = 9.
  const c = [
    0.99999999999980993, 676.5203681218851, -1259.1392167224028, 771.32342877765313, -176.61502916214059,
    12.507343278686905, -0.13857109526572012, 9.9843695780195716e-6, 1.5056327351493116e-7,
  ];
  if (x < 0.5) return Math.log(Math.PI / Math.sin(Math.PI * x)) - logGamma(1 - x);
  let sum = c[0];
  for (let i = 1; i < 9; ++i) sum += c[i] / (x - 1 + i);
  const t = x + 6.5;
  return 0.5 * Math.log(2 * Math.PI) + (x - 0.5) * Math.log(t) - t + Math.log(sum);
}

/** The regularised incomplete beta function, by its continued fraction. */
function incompleteBeta(x: number, a: number, b: number): number {
  if (x <= 0) return 0;
  if (x >= 1) return 1;
  if (x > (a + 1) / (a + b + 2)) return 1 - incompleteBeta(1 - x, b, a);
  const front = Math.exp(logGamma(a + b) - logGamma(a) - logGamma(b) + a * Math.log(x) + b * Math.log1p(-x)) / a;
  let f = 1;
  let c = 1;
  let d = 0;
  for (let i = 0; i <= 500; ++i) {
    const m = i >> 1;
    const numerator =
      i === 0
        ? 1
        : i % 2 === 0
          ? (m * (b - m) * x) / ((a + 2 * m - 1) * (a + 2 * m))
          : -((a + m) * (a + b + m) * x) / ((a + 2 * m) * (a + 2 * m + 1));
    d = 1 / (1 + numerator * d || 1e-300);
    c = 1 + numerator / c || 1e-300;
    const step = c * d;
    f *= step;
    if (Math.abs(step - 1) < 1e-15) break;
  }
  return front * (f - 1);
}

/** Student's t below which a share `p` > 1/2 lies. */
function studentQuantile(p: number, freedom: number): number {
  const below = (t: number): number => 1 - 0.5 * incompleteBeta(freedom / (freedom + t * t), freedom / 2, 0.5);
  let low = 0;
  let high = 1;
  while (below(high) < p) high *= 2;
  for (let i = 0; i < 200 && high - low > 1e-14 * high; ++i) {
    const middle = 0.5 * (low + high);
    if (below(middle) < p) low = middle;
    else high = middle;
  }
  return 0.5 * (low + high);
}

const kNormal = 1.959963984540054;

function scoreInterval(rate: number, n: number, z: number): Interval {
  const middle = (rate + (z * z) / (2 * n)) / (1 + (z * z) / n);
  const half = (z / (1 + (z * z) / n)) * Math.sqrt((rate * (1 - rate)) / n + (z * z) / (4 * n * n));
  // At rates 0 and 1 the end is the rate itself.
  return { lower: rate === 0 ? 0 : Math.max(0, middle - half), upper: rate === 1 ? 1 : Math.min(1, middle + half) };
}

/** Of the success rate on maps like these, from five maps on widened by how much they differ: [successes, trials] of each map. */
export function successInterval(maps: Iterable<[number, number]>): Interval {
  const flown = [...maps].filter(([, trials]) => trials > 0);
  const n = flown.reduce((sum, [, trials]) => sum + trials, 0);
  const finished = flown.reduce((sum, [successes]) => sum + successes, 0);
  if (n === 0) return { lower: NaN, upper: NaN };
  const rate = finished / n;
  if (flown.length < 5) return scoreInterval(rate, n, kNormal);
  let effective = n;
  if (rate > 0 && rate < 1) {
    let squares = 0;
    for (const [successes, trials] of flown) squares += (successes - rate * trials) ** 2;
    const variance = ((flown.length / (flown.length - 1)) * squares) / (n * n);
    effective = n / Math.max(1, variance / ((rate * (1 - rate)) / n));
  }
  return scoreInterval(rate, effective, studentQuantile(0.975, flown.length - 1));
}

/** The likeliest curve of success over x, [x, successes, trials] of each map; null where there is none. */
export function logisticFit(points: [number, number, number][]): { intercept: number; slope: number } | null {
  const used = points.filter(([x, , n]) => Number.isFinite(x) && n > 0);
  const failing = used.filter(([, s, n]) => s < n).map(([x]) => x);
  const passing = used.filter(([, s]) => s > 0).map(([x]) => x);
  if (!failing.length || !passing.length) return null;
  // Separated: no finite slope is likeliest.
  if (Math.max(...failing) <= Math.min(...passing) || Math.max(...passing) <= Math.min(...failing)) return null;
  const mean = used.reduce((sum, [x, , n]) => sum + x * n, 0) / used.reduce((sum, [, , n]) => sum + n, 0);
  const likelihood = (a: number, b: number): number => {
    let sum = 0;
    for (const [x, s, n] of used) {
      const u = a + b * (x - mean);
      sum += s * u - n * (u > 0 ? u + Math.log1p(Math.exp(-u)) : Math.log1p(Math.exp(u)));
    }
    return sum;
  };
  let a = 0;
  let b = 0;
  let best = likelihood(a, b);
  for (let i = 0; i < 100; ++i) {
    let ga = 0,
      gb = 0,
      haa = 0,
      hab = 0,
      hbb = 0;
    for (const [x, s, n] of used) {
      const u = x - mean;
      const p = 1 / (1 + Math.exp(-(a + b * u)));
      const w = n * p * (1 - p);
      ga += s - n * p;
      gb += (s - n * p) * u;
      haa += w;
      hab += w * u;
      hbb += w * u * u;
    }
    const determinant = haa * hbb - hab * hab;
    if (!(determinant > 1e-300)) return null;
    const da = (hbb * ga - hab * gb) / determinant;
    const db = (haa * gb - hab * ga) / determinant;
    let share = 1;
    let next = likelihood(a + da, b + db);
    while (!(next >= best) && share > 1e-9) {
      share /= 2;
      next = likelihood(a + share * da, b + share * db);
    }
    a += share * da;
    b += share * db;
    const gain = next - best;
    best = next;
    if (Math.abs(gain) < 1e-13 * (1 + Math.abs(best))) break;
  }
  return { intercept: a - b * mean, slope: b };
}

/** Quantile of sorted numbers, by linear interpolation. */
export function quantile(sorted: ArrayLike<number>, share: number): number {
  if (sorted.length === 0) return NaN;
  const at = share * (sorted.length - 1);
  const low = Math.floor(at);
  const high = Math.min(low + 1, sorted.length - 1);
  return sorted[low] + (at - low) * (sorted[high] - sorted[low]);
}

/** Round ticks over a range. */
export function ticks(low: number, high: number, count: number): number[] {
  if (!(high > low)) return [low];
  const rough = (high - low) / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((f) => f * power).find((s) => s >= rough) ?? 10 * power;
  const all: number[] = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k)
    all.push(Number((k * step).toPrecision(12)));
  return all;
}

/** Places within low to high, `gap` or more apart, in the order of those wanted and as near to them as can be. */
export function apart(wanted: number[], gap: number, low: number, high: number): number[] {
  const order = [...wanted.keys()].sort((a, b) => wanted[a] - wanted[b] || a - b);
  // Less their gaps they only must not fall: those that would are put at their mean.
  const blocks: { sum: number; count: number }[] = [];
  const mean = (at: number): number => blocks[at].sum / blocks[at].count;
  order.forEach((i, k) => {
    blocks.push({ sum: wanted[i] - k * gap, count: 1 });
    for (let at = blocks.length - 1; at > 0 && mean(at - 1) > mean(at); --at) {
      const last = blocks.pop()!;
      blocks[at - 1].sum += last.sum;
      blocks[at - 1].count += last.count;
    }
  });
  const most = high - (wanted.length - 1) * gap;
  const starts = blocks.flatMap((b, at) => Array<number>(b.count).fill(Math.max(low, Math.min(mean(at), most))));
  const places: number[] = [];
  order.forEach((i, k) => {
    places[i] = starts[k] + k * gap;
  });
  return places;
}
